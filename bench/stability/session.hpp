// All of `wedge bench stability`: the suite is rendered and analysed as any comparison
// (bench/converge), then judged.
#pragma once

#include "bench/converge/session.hpp"
#include "bench/stability/verdict.hpp"

namespace wedge::stability {

struct Outcome {
    std::filesystem::path report, results;  ///< HTML; JSON of all verdicts
    std::string table;                      ///< for a terminal
    std::size_t scenes = 0;
    std::vector<std::string> warnings;
};

/// Throws converge::Stopped if `config.stop` was set: finished runs are kept. `markdown`: a file
/// for the tables; empty: none.
Outcome run_suite(const Suite& suite, converge::Config config, const LoadOptions& load,
                  const std::filesystem::path& markdown, const converge::Say& say);

}  // namespace wedge::stability
