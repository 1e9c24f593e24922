// Errors for people: what happened, where, and what to do about it, in one message.
#pragma once

#include <stdexcept>
#include <string>

namespace wedge {

/// What went wrong, in the classes a script may want to tell apart. The values are the exit codes
/// of the command-line program.
enum class ErrorKind {
    internal = 1,   ///< a fault of this program
    usage = 2,      ///< the call itself is wrong: unknown option, impossible combination
    bad_input = 3,  ///< a scene, mesh, texture or image cannot be used as it is
    device = 4,     ///< no OpenCL device, a kernel that does not build, memory that is not there
    output = 5,     ///< a result cannot be written
};

/// Thrown for everything that is not a programming error (those are asserted).
class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

  private:
    ErrorKind kind_;
};

}  // namespace wedge
