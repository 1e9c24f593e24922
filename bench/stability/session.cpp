#include "bench/stability/session.hpp"

#include <algorithm>

#include "bench/stability/tables.hpp"
#include "host/base/atomic_file.hpp"
#include "wedge/error.hpp"

namespace wedge::stability {
namespace {

std::vector<Row> judge_all(const Suite& suite, const converge::Analysis& analysis) {
    std::vector<Row> rows;
    for (const Recipe& recipe : suite.recipes) {
        const auto scene =
            std::find_if(analysis.scenes.begin(), analysis.scenes.end(),
                         [&](const auto& s) { return s.scene->name == recipe.scene_name(); });
        if (scene == analysis.scenes.end())
            throw Error(ErrorKind::internal, recipe.scene + ": was not analysed");
        rows.push_back(judge(recipe, *scene, suite.limits));
    }
    return rows;
}

}  // namespace

Outcome run_suite(const Suite& suite, converge::Config config, const LoadOptions& load,
                  const std::filesystem::path& markdown, const converge::Say& say) {
    config.scenes.clear();
    for (const Recipe& recipe : suite.recipes) config.scenes.push_back(recipe.scene);
    converge::complete(config);

    Outcome outcome;
    outcome.results = config.folder / "stability.json";
    outcome.scenes = suite.recipes.size();
    const auto section = [&](const converge::Analysis& analysis) {
        const std::vector<Row> rows = judge_all(suite, analysis);
        write_file_atomically(outcome.results, verdicts_json(suite, rows).dump(1) + "\n");
        if (!markdown.empty())
            write_file_atomically(markdown, verdicts_markdown(config, suite, rows));
        outcome.table = verdicts_text(rows);
        return verdicts_html(suite, rows);
    };
    const converge::Outcome whole = converge::converge(config, load, {}, say, section);
    outcome.report = whole.report;
    outcome.warnings = whole.warnings;
    return outcome;
}

}  // namespace wedge::stability
