#include "tests/cli/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>

extern char** environ;

namespace wedge::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPoll_ms = 20;
constexpr int kExecFailed = 127;

struct Pipe {
    int read_end = -1, write_end = -1;
    Pipe() {
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe2 failed");
        read_end = ends[0];
        write_end = ends[1];
    }
    ~Pipe() {
        close(read_end);
        close_writing();
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    void close_writing() {
        if (write_end >= 0) close(write_end);
        write_end = -1;
    }
};

std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable; ++variable) {
        const std::string text = *variable;
        if (!changes.contains(text.substr(0, text.find('=')))) variables.push_back(text);
    }
    for (const auto& [name, value] : changes) variables.push_back(name + "=" + value);
    return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& strings) {
    std::vector<char*> pointers;
    for (std::string& string : strings) pointers.push_back(string.data());
    pointers.push_back(nullptr);
    return pointers;
}

// Between fork and exec, so only plain system calls.
[[noreturn]] void become(char** arguments, char** variables, const ProcessSettings& settings,
                         const Pipe& out, const Pipe& err) {
    dup2(out.write_end, STDOUT_FILENO);
    dup2(err.write_end, STDERR_FILENO);
    signal(SIGINT, SIG_DFL);  // a test run in the background would hand on an ignored one
    if (settings.largest_file_bytes) {
        const rlimit limit{*settings.largest_file_bytes, *settings.largest_file_bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
        signal(SIGXFSZ, SIG_IGN);  // so that write() fails instead
    }
    if (chdir(settings.folder.c_str()) == 0) execve(arguments[0], arguments, variables);
    _exit(kExecFailed);
}

// False at the end of the stream.
bool read_some(int descriptor, std::string& text) {
    std::array<char, 4096> buffer;
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count > 0) text.append(buffer.data(), std::size_t(count));
    return count > 0;
}

void collect(pid_t child, const Pipe& out, const Pipe& err, const ProcessSettings& settings,
             Clock::time_point start, ProcessResult& result) {
    bool interrupted = false;
    std::array<pollfd, 2> streams{pollfd{out.read_end, POLLIN, 0}, pollfd{err.read_end, POLLIN, 0}};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
        poll(streams.data(), streams.size(), kPoll_ms);
        if (streams[0].revents && !read_some(out.read_end, result.out)) streams[0].fd = -1;
        if (streams[1].revents && !read_some(err.read_end, result.err)) streams[1].fd = -1;
        for (pollfd& stream : streams) stream.revents = 0;
        if (!interrupted && settings.interrupt_when && settings.interrupt_when(result.err)) {
            interrupted = true;
            kill(child, SIGINT);
        }
        if (settings.kill_when && settings.kill_when()) kill(child, SIGKILL);
        const std::chrono::duration<double> elapsed = Clock::now() - start;
        if (!result.timed_out && elapsed.count() > settings.timeout_s) {
            result.timed_out = true;
            kill(child, SIGKILL);
        }
    }
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& command,
                          const ProcessSettings& settings) {
    std::vector<std::string> arguments = command;
    std::vector<std::string> variables = environment_with(settings.environment);
    const std::vector<char*> argument_pointers = pointers_to(arguments);
    const std::vector<char*> variable_pointers = pointers_to(variables);
    Pipe out, err;

    const auto start = Clock::now();
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork failed");
    if (child == 0)
        become(const_cast<char**>(argument_pointers.data()),
               const_cast<char**>(variable_pointers.data()), settings, out, err);
    out.close_writing();
    err.close_writing();

    ProcessResult result;
    collect(child, out, err, settings, start, result);
    int status = 0;
    waitpid(child, &status, 0);
    result.wall_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    return result;
}

}  // namespace wedge::test
