#include "bench/converge/session.hpp"

#include <fmt/format.h>

#include <set>

#include "bench/converge/markdown.hpp"
#include "bench/converge/report.hpp"
#include "host/base/atomic_file.hpp"
#include "wedge/error.hpp"

namespace wedge::converge {
namespace {

void check_names(const std::vector<SceneRuns>& scenes) {
    std::set<std::string> names;
    for (const SceneRuns& scene : scenes)
        if (!names.insert(scene.name).second)
            throw Error(ErrorKind::usage, scene.name + ": two scenes have this name");
}

}  // namespace

Outcome converge(const Config& config, const LoadOptions& load,
                 const std::filesystem::path& markdown, const Say& say) {
    std::vector<SceneRuns> scenes;
    for (const std::string& file : config.scenes)
        scenes.push_back(run_scene(config, file, load, say));
    check_names(scenes);

    // Pictures need the images, so all stay until the report is written.
    std::vector<std::vector<Image>> images;
    std::vector<SceneAnalysis> analysed;
    for (const SceneRuns& scene : scenes) {
        say(scene.name + ": errors and tests");
        images.push_back(read_images(config, scene));
        analysed.push_back(
            analyse(config, scene, images.back(), errors_of_runs(config, scene, images.back())));
    }
    const Analysis analysis = summarise(std::move(analysed));

    Outcome outcome{config.folder / "report.html", config.folder / "results.json", {}};
    for (const SceneAnalysis& scene : analysis.scenes)
        outcome.warnings.insert(outcome.warnings.end(), scene.warnings.begin(),
                                scene.warnings.end());
    write_file_atomically(outcome.json, results_json(config, analysis).dump(1) + "\n");
    write_file_atomically(outcome.report, report_html(config, analysis));
    if (!markdown.empty()) write_file_atomically(markdown, markdown_tables(config, analysis));
    return outcome;
}

}  // namespace wedge::converge
