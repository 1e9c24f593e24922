// What the commands under `wedge bench` that measure errors have in common.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/converge/config.hpp"
#include "wedge/scene.hpp"

namespace wedge::cli {

/// As typed.
struct MeasuringArguments {
    std::vector<std::string> methods, budgets, asset_paths;
    std::string folder, references, device, kernel_dir;
    std::optional<int> seeds, reference_spp;
    bool any_build = false;
};

/// Options whose help is the same everywhere.
void add_measuring_options(CLI::App& command, MeasuringArguments& arguments);

/// A list that commas separate, for `--methods` and its like.
void add_list(CLI::App& command, const std::string& name, std::vector<std::string>& values,
              const std::string& help);

/// `--budgets`, which may be repeated.
void add_budgets(CLI::App& command, MeasuringArguments& arguments, const std::string& help);

/// What was typed, over what `config` has already.
void take_measuring_arguments(const MeasuringArguments& arguments, converge::Config& config);

/// Runs `measure` until it is done or the user stops it, which throws Interrupted.
void measure_until_stopped(converge::Config& config, const MeasuringArguments& arguments,
                           const std::function<void(const LoadOptions& load)>& measure);

}  // namespace wedge::cli
