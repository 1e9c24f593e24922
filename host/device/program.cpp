#include "host/device/program.hpp"

#include <fmt/format.h>

#include <exception>
#include <future>
#include <sstream>

#include "host/device/binary_cache.hpp"
#include "host/device/status.hpp"
#include "wedge/error.hpp"

namespace wedge::device {
namespace {

constexpr int kLogLinesShown = 100;  // the first errors are the ones to mend

std::string first_lines(const std::string& text, int count) {
    std::istringstream lines(text);
    std::string line, kept;
    while (std::getline(lines, line)) {
        if (count-- == 0) return kept + "  ...\n";
        kept += "  " + line + "\n";
    }
    return kept;
}

[[noreturn]] void fail_build(const Device& device, const ProgramRequest& request,
                             const std::string& options, const cl::Program& program,
                             cl_int status) {
    std::string log;
    try {
        log = trimmed(program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.handle()));
    } catch (const cl::Error&) {
        log = "(the driver gives no build log)";
    }
    throw Error(
        ErrorKind::device,
        fmt::format("device {}: cannot build {} ({}): {}\n{}", device.info().name, request.file,
                    options, status_name(status), first_lines(log, kLogLinesShown)));
}

/// A program from a cached binary, or nothing if the driver does not want it any more.
cl::Program build_from_binary(const Device& device, const std::string& binary,
                              const std::string& options) {
    try {
        const std::vector<std::vector<unsigned char>> binaries = {{binary.begin(), binary.end()}};
        cl::Program program(device.context(), {device.handle()}, binaries);
        program.build({device.handle()}, options.c_str());
        return program;
    } catch (const cl::Error&) {
        return {};
    }
}

cl::Program build_from_source(const Device& device, const ProgramRequest& request,
                              const std::string& source, const std::string& options) {
    cl::Program program;
    try {
        program = cl::Program(device.context(), source);
        program.build({device.handle()}, options.c_str());
        return program;
    } catch (const cl::Error& error) {
        if (program() == nullptr) {
            throw_status(device.info().name, "take the source of " + request.file, error.err());
        }
        fail_build(device, request, options, program, error.err());
    }
}

void store_binary(const std::string& name, const cl::Program& program) {
    try {
        const std::vector<std::vector<unsigned char>> binaries =
            program.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.size() != 1 || binaries[0].empty()) return;
        store_cached(name, {reinterpret_cast<const char*>(binaries[0].data()), binaries[0].size()});
    } catch (const cl::Error&) {
        // Not every driver hands binaries out.
    }
}

Program build_one(const Device& device, const ProgramRequest& request,
                  const std::string& kernel_dir) {
    const std::string source = assemble_source(request.file, kernel_dir);
    const std::string options = build_options(request);
    if (!caches_programs(device)) {
        return {build_from_source(device, request, source, options), false};
    }

    const std::string name = cache_key(device, source, options) + ".program";
    if (const std::optional<std::string> binary = load_cached(name)) {
        if (cl::Program program = build_from_binary(device, *binary, options); program()) {
            return {std::move(program), true};
        }
    }
    cl::Program program = build_from_source(device, request, source, options);
    store_binary(name, program);
    return {std::move(program), false};
}

}  // namespace

std::string build_options(const ProgramRequest& request) {
    std::string options = "-cl-std=CL1.2";
    for (const std::string& define : request.defines) options += " -D" + define;
    return options;
}

cl::Kernel Program::kernel(const char* name) const {
    try {
        return cl::Kernel(program, name);
    } catch (const cl::Error& error) {
        throw Error(ErrorKind::device,
                    fmt::format("cannot get kernel {}: {}", name, status_name(error.err())));
    }
}

std::vector<Program> build_programs(Device& device, std::span<const ProgramRequest> requests,
                                    const std::string& kernel_dir) {
    // Oclgrind's compiler crashes when it is called twice at the same time.
    const auto when =
        device.info().platform == "Oclgrind" ? std::launch::deferred : std::launch::async;
    std::vector<std::future<Program>> builds;
    for (const ProgramRequest& request : requests) {
        builds.push_back(std::async(when, [&device, &request, &kernel_dir] {
            return build_one(device, request, kernel_dir);
        }));
    }
    // A future's destructor waits, so that no build outlives an error of one before it.
    std::vector<Program> programs;
    for (std::future<Program>& build : builds) programs.push_back(build.get());
    return programs;
}

}  // namespace wedge::device
