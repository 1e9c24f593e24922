#include "bench/converge/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "bench/converge/calibration.hpp"
#include "bench/converge/identity.hpp"
#include "bench/converge/method_run.hpp"
#include "bench/converge/peer_runs.hpp"
#include "bench/converge/reference_margin.hpp"
#include "bench/peers/scene_export.hpp"
#include "host/base/atomic_file.hpp"
#include "host/device/device.hpp"
#include "wedge/error.hpp"
#include "wedge/image_io.hpp"

namespace wedge::converge {
namespace {

namespace fs = std::filesystem;

struct Task {
    const Method* method;
    Budget budget;
    uint32_t seed;
    std::string key;
};

std::string key_of(const std::string& digest, const Method& method, const Budget& budget,
                   uint32_t seed, const DeviceInfo& device) {
    if (!method.external_source) return run_key(digest, method, budget, seed, device);
    return run_key(digest, find_method(method.external_source), budget, seed, device) + "-" +
           method.external_tag;
}

/// Seeds outside, methods inside.
std::vector<Task> all_tasks(const Config& config, const std::string& digest,
                            const DeviceInfo& device) {
    std::size_t rungs = 0;
    for (const std::string& name : config.methods)
        rungs = std::max(rungs, ladder(config, find_method(name)).size());
    std::vector<Task> tasks;
    for (int seed = 0; seed < config.seeds; ++seed)
        for (std::size_t rung = 0; rung < rungs; ++rung)
            for (const std::string& name : config.methods) {
                const Method& method = find_method(name);
                const std::vector<Budget> budgets = ladder(config, method);
                if (rung < budgets.size())
                    tasks.push_back(
                        {&method, budgets[rung], uint32_t(seed),
                         key_of(digest, method, budgets[rung], uint32_t(seed), device)});
            }
    return tasks;
}

/// The latest whole record of each key that may be used.
std::map<std::string, RunRecord> finished_runs(const Config& config, const std::string& program) {
    std::map<std::string, RunRecord> runs;
    for (const nlohmann::json& line : read_lines(config.folder / "runs.jsonl")) {
        try {
            RunRecord record = run_record_from(line);
            if (!config.any_build && record.program != program) continue;
            if (fs::exists(config.folder / record.image)) runs[record.key] = std::move(record);
        } catch (const nlohmann::json::exception&) {
            // Of another version of this program: as if it were not there.
        }
    }
    return runs;
}

/// What analysis and others who want to recompute need. Variance only says something of unfiltered
/// pixels; those are what other denoisers may start from, too.
Image kept_layers(const Image& image, bool is_unfiltered) {
    std::vector<std::string> names{"R", "G", "B"};
    if (is_unfiltered)
        names.insert(names.end(), {"variance.R", "variance.G", "variance.B", "albedo.R", "albedo.G",
                                   "albedo.B", "N.X", "N.Y", "N.Z"});
    Image kept{image.width, image.height, names, {}, image.metadata};
    std::vector<std::size_t> from;
    for (const std::string& name : names) from.push_back(std::size_t(image.channel(name)));
    const std::size_t stride = image.channels.size();
    for (std::size_t i = 0; i < image.pixels.size(); i += stride)
        for (std::size_t channel : from) kept.pixels.push_back(image.pixels[i + channel]);
    return kept;
}

void copy_stats(const RenderStats& stats, bool cpu_clock, RunRecord& record) {
    record.flatten_s = stats.flatten_s;
    record.bvh_build_s = stats.bvh_build_s;
    record.upload_s = stats.upload_s;
    record.compile_s = stats.compile_s;
    record.render_s = stats.render_s;
    record.time_s = counted_seconds(stats, cpu_clock);
    if (stats.estimated_error) record.predicted_rmse = stats.estimated_error->rmse;
    record.passes = stats.passes;
    record.rays = stats.rays;
    record.samples = stats.samples;
    record.non_finite_samples = stats.non_finite_samples;
    record.device = stats.device.name;
    record.driver = stats.device.driver;
    record.platform = stats.device.platform + ", " + stats.device.platform_version;
}

class SceneRunner {
  public:
    SceneRunner(const Config& config, const Scene& scene, SceneRuns& out, const Say& say)
        : config_(config),
          out_(out),
          say_(say),
          methods_(config, scene),
          peers_(config, scene, out.name, out.digest) {}

    void run_missing() {
        const std::string program = program_digest(config_.kernel_dir);
        const device::Device device(config_.device);
        std::map<std::string, RunRecord> done = finished_runs(config_, program);
        const std::vector<Task> tasks = all_tasks(config_, out_.digest, device.info());
        const auto missing = std::count_if(tasks.begin(), tasks.end(), [&](const Task& t) {
            return !done.count(t.key) && !t.method->external_source;
        });
        if (missing < std::ptrdiff_t(tasks.size()))
            say_(fmt::format("{}: {} of {} runs are there from before", out_.name,
                             tasks.size() - std::size_t(missing), tasks.size()));
        std::ptrdiff_t number = 0;
        for (const Task& task : tasks) {
            auto found = done.find(task.key);
            if (found == done.end() && task.method->external_source) continue;
            if (found == done.end()) {
                ++number;
                found = done.emplace(task.key, run(task, program)).first;
                say_(fmt::format("{} {}/{}: {} {}={:g} seed {}: {:.3g} s", out_.name, number,
                                 missing, task.method->name, name_of(task.budget.unit),
                                 task.budget.value, task.seed, found->second.time_s));
            }
            knobs_[{task.method, task.budget.value}] = found->second.knob;
            out_.runs.push_back(found->second);
        }
        out_.peer_references = peers_.references(say_);
    }

  private:
    /// The first run of a method on a scene would pay for compiling what its passes launch late.
    void warm_up(const Method& method) {
        if (!warm_.insert(&method).second) return;
        const double least =
            method.knob == Knob::spp ? config_.budgets.spp.front() : config_.budgets.mu.front();
        methods_.run(method, least, 0);
    }

    double knob_for(const Method& method, const Budget& budget) {
        if (budget.unit != BudgetUnit::seconds) return budget.value;
        if (const auto known = knobs_.find({&method, budget.value}); known != knobs_.end())
            return known->second;
        auto [calibration, is_new] = calibrations_.try_emplace(&method);
        if (is_new)
            calibration->second = calibrate(method.knob, [&](double knob) {
                return method.peer_script ? peers_.seconds(method, knob)
                                          : counted_seconds(methods_.run(method, knob, 0).stats,
                                                            config_.cpu_clock);
            });
        return knob_for_seconds(calibration->second, method.knob, budget.value);
    }

    RunRecord run(const Task& task, const std::string& program) {
        const Method& method = *task.method;
        if (method.peer_script) return run_peer(task, program);
        warm_up(method);
        const double knob = knob_for(method, task.budget);
        const Frame frame = methods_.run(method, knob, task.seed);

        RunRecord record = new_record(task, program);
        record.knob = knob;
        record.command = fmt::format("wedge render {} --size {}x{} --bounces {} {}", out_.file,
                                     out_.film.width, out_.film.height, out_.bounces,
                                     render_arguments(methods_.options(method, knob, task.seed))) +
                         (method.filter ? fmt::format(" # then {}", method.name) : "");
        copy_stats(frame.stats, config_.cpu_clock, record);
        keep(record, kept_layers(frame.image, !method.biased));
        return record;
    }

    RunRecord run_peer(const Task& task, const std::string& program) {
        RunRecord record = new_record(task, program);
        record.knob = knob_for(*task.method, task.budget);
        const Image image = peers_.run(*task.method, record);
        record.command = fmt::format("{} {} # {}, {:g} samples a pixel, seed {}", config_.python,
                                     task.method->peer_script, out_.file, record.knob, task.seed);
        keep(record, image);
        return record;
    }

    RunRecord new_record(const Task& task, const std::string& program) const {
        RunRecord record;
        record.key = task.key;
        record.scene = out_.name;
        record.scene_digest = out_.digest;
        record.method = task.method->name;
        record.budget = task.budget;
        record.seed = task.seed;
        record.width = out_.film.width;
        record.height = out_.film.height;
        record.version = version();
        record.program = program;
        record.commit = built_from_commit();
        record.settings = settings_json(*task.method);
        record.image = fmt::format("images/{}-{}-{}{:g}-seed{}-{}.exr", out_.name, record.method,
                                   name_of(task.budget.unit), task.budget.value, task.seed,
                                   task.key.substr(0, 8));
        return record;
    }

    void keep(const RunRecord& record, const Image& image) const {
        write_exr(config_.folder / record.image, image);
        append_line(config_.folder / "runs.jsonl", to_json(record).dump());
    }

    const Config& config_;
    SceneRuns& out_;
    const Say& say_;
    MethodRunner methods_;
    PeerRuns peers_;
    std::set<const Method*> warm_;
    std::map<const Method*, Calibration> calibrations_;
    std::map<std::pair<const Method*, double>, double> knobs_;
};

}  // namespace

Scene scene_to_measure(const Config& config, const std::string& scene_file, const LoadOptions& load,
                       const Say& say) {
    Scene scene = load_scene(scene_file, load);
    scene.film = film_for(config.size, scene.film);
    if (config.bounces) scene.defaults.bounces = *config.bounces;
    bool any_peer = false, lambert_only = false;
    for (const std::string& name : config.methods) {
        any_peer = any_peer || find_method(name).peer_script;
        lambert_only = lambert_only || find_method(name).lambert_only;
    }
    if (any_peer)
        for (const std::string& line : peers::simplify_for_peers(scene, lambert_only)) say(line);
    return scene;
}

ReferenceRequest reference_request(const Config& config, const std::string& name,
                                   const std::string& digest, const Say& say) {
    ReferenceRequest request;
    request.folder = config.references;
    request.name = name;
    request.scene_digest = digest;
    request.spp = config.reference_spp;
    request.sampler = config.reference_sampler;
    request.device = config.device;
    request.kernel_dir = config.kernel_dir;
    request.stop = config.stop;
    request.say = say;
    return request;
}

SceneRuns run_scene(const Config& config, const std::string& scene_file, const LoadOptions& load,
                    const Say& say) {
    const Scene scene = scene_to_measure(config, scene_file, load, say);
    make_folder(config.folder / "images");

    SceneRuns out;
    out.name = fs::path(scene_file).stem().string();
    out.digest = digest_of(scene);
    out.file = scene_file;
    out.film = scene.film;
    out.bounces = scene.defaults.bounces;
    out.exposure = scene.defaults.exposure;
    for (const Instance& instance : scene.instances)
        out.triangles += scene.meshes[instance.mesh].triangles.size();
    ReferenceRequest request = reference_request(config, out.name, out.digest, say);
    out.reference = make_reference(scene, request);
    SceneRunner(config, scene, out, say).run_missing();
    request.piece_samples = out.reference.piece_samples;
    request.limit_s = config.reference_time_s;
    const auto more = [&](uint64_t spp) {
        request.spp = int(spp);
        return make_reference(scene, request);
    };
    improve_reference(config, out.runs, more, say, out.reference);
    return out;
}

}  // namespace wedge::converge
