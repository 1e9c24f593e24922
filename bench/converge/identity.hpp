// Names by content: results are used again only where nothing has changed that they depend on.
#pragma once

#include <string>

#include "wedge/scene.hpp"

namespace wedge::converge {

/// SHA-256 of everything in the scene that a render can see, film and bounces included; 16
/// hexadecimal digits.
std::string digest_of(const Scene& scene);

/// SHA-256 of the running program and, if given, of the kernels read instead of its own; 16
/// hexadecimal digits.
std::string program_digest(const std::string& kernel_dir);

/// Commit the program was built from, with "+" if files had been changed; empty if not known.
std::string built_from_commit();

}  // namespace wedge::converge
