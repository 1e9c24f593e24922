// All of `wedge bench peers --check`: do other renderers come to the same image?
#pragma once

#include "bench/converge/analysis.hpp"

namespace wedge::converge {

/// Above this probability of so large a difference by chance, images agree.
inline constexpr double kAgreementLevel = 1e-3;

struct AgreementFiles {
    Agreement agreement;
    bool agrees = false;
    std::string text;               ///< for people, a few lines
    std::filesystem::path picture;  ///< ours, theirs, and their difference side by side
};

/// Converged images of one scene, `Config::reference_spp` samples a pixel each, ours against that
/// of each other renderer among the methods. Throws as converge().
std::vector<AgreementFiles> check_agreement(const Config& config, const std::string& scene_file,
                                            const LoadOptions& load, const Say& say);

}  // namespace wedge::converge
