#include "bench/peers/peer_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "wedge/error.hpp"

namespace wedge::peers {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kLogTail = 800;  // bytes that are quoted

std::string tail_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    const std::string all = text.str();
    return all.size() <= kLogTail ? all : "…" + all.substr(all.size() - kLogTail);
}

/// In the child: only what POSIX allows between fork and exec.
[[noreturn]] void become(const char* python, const char* script, int in, int out, int err) {
    ::dup2(in, 0);
    ::dup2(out, 1);
    ::dup2(err, 2);
    // Ctrl-C is for the parent, which tells its children by closing their stdin.
    ::setpgid(0, 0);
    ::execlp(python, python, "-u", script, static_cast<char*>(nullptr));
    constexpr char kFailed[] = "cannot be run: ";
    for (const char* text : {kFailed, python, "\n"})
        [[maybe_unused]] const auto written = ::write(2, text, std::strlen(text));
    _exit(127);
}

}  // namespace

fs::path peers_folder() {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    for (const fs::path& folder :
         {program.parent_path().parent_path() / "share/wedge/peers", fs::path(WEDGE_PEERS_DIR)})
        if (fs::exists(folder / "peer_loop.py", ignored)) return folder;
    throw Error(ErrorKind::usage,
                fmt::format("the scripts that drive other renderers are not found, neither beside "
                            "the program nor in {}",
                            WEDGE_PEERS_DIR));
}

PeerProcess::PeerProcess(const std::string& python, const std::string& script, fs::path log)
    : script_(script), log_(std::move(log)) {
    const std::string path = (peers_folder() / script).string();
    // A socket rather than pipes: writing to a peer that has ended is then an error, not a signal.
    int ends[2];
    const int err = ::open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (err < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw Error(ErrorKind::output,
                    fmt::format("{}: cannot be opened: {}", log_.string(), std::strerror(errno)));
    child_ = ::fork();
    if (child_ == 0) become(python.c_str(), path.c_str(), ends[1], ends[1], err);
    ::close(ends[1]);
    ::close(err);
    socket_ = ends[0];
    if (child_ < 0) {
        ::close(socket_);
        throw Error(ErrorKind::usage,
                    fmt::format("{}: cannot be started: {}", python, std::strerror(errno)));
    }
}

PeerProcess::~PeerProcess() {
    ::close(socket_);
    // It may be in the middle of a render that nobody waits for.
    ::kill(child_, SIGTERM);
    ::waitpid(child_, nullptr, 0);
}

void PeerProcess::fail(const std::string& what) const {
    throw Error(ErrorKind::device, fmt::format("{}: {}\n{}", script_, what, tail_of(log_)));
}

json PeerProcess::ask(const json& request) {
    const std::string line = request.dump() + "\n";
    if (::send(socket_, line.data(), line.size(), MSG_NOSIGNAL) != ssize_t(line.size()))
        fail("has ended");
    std::size_t end;
    while ((end = unread_.find('\n')) == unread_.npos) {
        char block[4096];
        const ssize_t count = ::recv(socket_, block, sizeof(block), 0);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail("has ended");
        unread_.append(block, std::size_t(count));
    }
    const json answer = json::parse(unread_.substr(0, end), nullptr, false);
    unread_.erase(0, end + 1);
    if (!answer.is_object()) fail("gave an answer that is no JSON object");
    if (answer.contains("error")) fail(answer["error"].get<std::string>());
    return answer;
}

Peer::Peer(const std::string& python, const std::string& script, const std::string& method,
           const fs::path& exported)
    : pixels_(exported / (method + ".bin")),
      process_(python, script, exported / (method + ".log")) {
    const json answer = process_.ask(
        {{"do", "load"}, {"folder", fs::absolute(exported).string()}, {"method", method}});
    version_ = answer.at("version").get<std::string>();
    device_ = answer.at("device").get<std::string>();
    load_s_ = answer.at("load_s").get<double>();
}

Peer::Rendered Peer::render(int spp, uint32_t seed, int parts) {
    const json answer = process_.ask({{"do", "render"},
                                      {"spp", spp},
                                      {"seed", seed},
                                      {"parts", parts},
                                      {"pixels", fs::absolute(pixels_).string()}});
    Rendered out;
    out.render_s = answer.at("render_s").get<double>();
    out.compile_s = answer.at("compile_s").get<double>();
    out.samples = answer.at("samples").get<uint64_t>();
    Image& image = out.image;
    image.width = answer.at("width").get<int>();
    image.height = answer.at("height").get<int>();
    image.channels = {"R", "G", "B"};
    if (parts > 1)
        image.channels.insert(image.channels.end(), {"variance.R", "variance.G", "variance.B"});
    image.metadata["wedge:renderer"] = version_;
    image.pixels.resize(std::size_t(image.width) * image.height * image.channels.size());
    std::ifstream in(pixels_, std::ios::binary);
    const auto bytes = std::streamsize(image.pixels.size() * sizeof(float));
    in.read(reinterpret_cast<char*>(image.pixels.data()), bytes);
    if (in.gcount() != bytes)
        throw Error(ErrorKind::device, fmt::format("{}: is not whole", pixels_.string()));
    std::error_code ignored;
    fs::remove(pixels_, ignored);
    return out;
}

}  // namespace wedge::peers
