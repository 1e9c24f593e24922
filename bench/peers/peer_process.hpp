// Another renderer in a process of its own, spoken to line by line (bench/peers/peer_loop.py).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "wedge/image.hpp"

namespace wedge::peers {

/// Folder of the Python programs: beside the installed program, else in the source tree. Throws
/// Error(usage) where they are in neither.
std::filesystem::path peers_folder();

/// Starts `python` FOLDER/`script`, and ends it. Its stderr goes to `log`.
class PeerProcess {
  public:
    /// Throws Error(usage) if it cannot be started.
    PeerProcess(const std::string& python, const std::string& script, std::filesystem::path log);
    PeerProcess(const PeerProcess&) = delete;
    PeerProcess& operator=(const PeerProcess&) = delete;
    ~PeerProcess();

    /// Sends one object and waits for the answer. Throws Error(device), with the end of the log,
    /// where the peer could not do it or is no more.
    nlohmann::json ask(const nlohmann::json& request);

  private:
    [[noreturn]] void fail(const std::string& what) const;

    std::string script_;
    std::filesystem::path log_;
    int child_ = -1, socket_ = -1;
    std::string unread_;
};

/// A renderer with one scene loaded.
class Peer {
  public:
    /// `method`: one of those of methods.cpp that name a peer. `exported`: see export_scene.
    Peer(const std::string& python, const std::string& script, const std::string& method,
         const std::filesystem::path& exported);

    struct Rendered {
        Image image;  ///< R, G, B; of several parts also variance.R, G, B (of the mean)
        double render_s = 0, compile_s = 0;
        uint64_t samples = 0;
    };
    /// `parts` > 1: that many independent renders of `spp` / `parts` samples, averaged.
    Rendered render(int spp, uint32_t seed, int parts = 1);

    const std::string& version() const { return version_; }
    const std::string& device() const { return device_; }
    double load_s() const { return load_s_; }  ///< reading files, building its tree

  private:
    std::filesystem::path pixels_;
    PeerProcess process_;
    std::string version_, device_;
    double load_s_ = 0;
};

}  // namespace wedge::peers
