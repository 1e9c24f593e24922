// Films that do not fit the device are rendered in bands of rows, one after the other. Random
// numbers go by the place on the film, so that what was sampled has the bits of the whole.
#pragma once

#include <vector>

#include "host/render/plan.hpp"
#include "wedge/render.hpp"

namespace wedge::rendering {

/// Of a film with its filters, if any: what it takes and how far pixels see.
struct BandNeeds {
    uint64_t pixel_bytes = 0;   ///< on the device
    uint64_t buffer_bytes = 0;  ///< of a pixel, in the largest buffer
    int margin_px = 0;          ///< rows that a band is rendered beyond what is kept of it
    int memory_quarters = 2;    ///< of the device's memory, which it may take
};

BandNeeds band_needs(const Plan& plan, const Film& film);

struct Band {
    Rect rendered;
    Rect kept;  ///< full rows of it
};

/// The crop in as few bands of full rows as fit, of about equal height, from the top. What fits is
/// what the device and options.film_bytes allow. Where that is little, margins are a quarter of a
/// band. Throws Error(usage) where there must be several and the options do not go with that.
std::vector<Band> cut_into_bands(const Rect& crop, const RenderOptions& options,
                                 const DeviceInfo& device, const BandNeeds& needs);

}  // namespace wedge::rendering
