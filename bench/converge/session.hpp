// All of `wedge bench converge`: render what is missing, analyse, write.
#pragma once

#include "bench/converge/analysis.hpp"

namespace wedge::converge {

/// Where results went.
struct Outcome {
    std::filesystem::path report, json;
    std::vector<std::string> warnings;
};

/// Makes one more section of the report.
using Section = std::function<std::string(const Analysis&)>;

/// Throws Stopped if `config.stop` was set: finished runs are kept, no report is written.
/// `markdown`: a file for the summary as Markdown tables; empty: none.
Outcome converge(const Config& config, const LoadOptions& load,
                 const std::filesystem::path& markdown, const Say& say,
                 const Section& section = {});

/// Raw results: every run with its errors, and all that was computed from them.
nlohmann::json results_json(const Config& config, const Analysis& analysis);

}  // namespace wedge::converge
