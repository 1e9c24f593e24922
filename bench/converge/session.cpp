#include "bench/converge/session.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// Methods of others may not have been run; one that is not there in every scene is left out.
std::vector<std::string> drop_absent_methods(const std::vector<SceneRuns>& scenes, Config& config) {
    std::vector<std::string> warnings;
    std::erase_if(config.methods, [&](const std::string& name) {
        const auto has_runs = [&](const SceneRuns& scene) {
            return std::any_of(scene.runs.begin(), scene.runs.end(),
                               [&](const RunRecord& run) { return run.method == name; });
        };
        if (std::all_of(scenes.begin(), scenes.end(), has_runs)) return false;
        warnings.push_back(fmt::format(
            "{} is left out: it is run by bench/peers/{}.py, to be called with {} now; then this "
            "command again",
            name, find_method(name).external_tag, config.folder.string()));
        return true;
    });
    return warnings;
}

}  // namespace

Outcome converge(const Config& asked, const LoadOptions& load,
                 const std::filesystem::path& markdown, const Say& say, const Section& section) {
    std::vector<SceneRuns> scenes;
    for (const std::string& file : asked.scenes)
        scenes.push_back(run_scene(asked, file, load, say));
    check_names(scenes);
    Config config = asked;
    const std::vector<std::string> absent = drop_absent_methods(scenes, config);

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

    Outcome outcome{config.folder / "report.html", config.folder / "results.json", absent};
    for (const SceneAnalysis& scene : analysis.scenes)
        outcome.warnings.insert(outcome.warnings.end(), scene.warnings.begin(),
                                scene.warnings.end());
    write_file_atomically(outcome.json, results_json(config, analysis).dump(1) + "\n");
    write_file_atomically(outcome.report,
                          report_html(config, analysis, section ? section(analysis) : ""));
    if (!markdown.empty()) write_file_atomically(markdown, markdown_tables(config, analysis));
    return outcome;
}

}  // namespace wedge::converge
