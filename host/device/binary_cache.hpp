// Compiled programs on disk, named by everything that went into them. Nothing here throws: a cache
// that does not work is slow, not an error.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host/device/device.hpp"

namespace wedge::device {

/// The folder ($WEDGE_CACHE_DIR, else $XDG_CACHE_HOME/wedge, else ~/.cache/wedge), empty if the
/// cache is off (WEDGE_CACHE=0) or there is no home.
std::string cache_folder();

/// Whether programs for this device are kept: not on PoCL, which keeps them itself, unless
/// WEDGE_CACHE=force.
bool caches_programs(const Device& device);

/// 64 hexadecimal digits that differ if source, options, device, driver, platform or format differ.
std::string cache_key(const Device& device, std::string_view source, std::string_view options);

/// What was stored under `name`, if it is there and whole.
std::optional<std::string> load_cached(const std::string& name);

void store_cached(const std::string& name, std::string_view payload);

}  // namespace wedge::device
