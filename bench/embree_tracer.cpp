#include "bench/tracers.hpp"

#ifdef WEDGE_HAVE_EMBREE
#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <atomic>
#include <cstring>

#include "host/base/parallel.hpp"
#include "host/base/stopwatch.hpp"
#include "wedge/error.hpp"
#endif

namespace wedge::bench {

#ifdef WEDGE_HAVE_EMBREE
namespace {

constexpr std::size_t kGrain = 4096;  // rays a task

class EmbreeTracer : public Tracer {
  public:
    explicit EmbreeTracer(RTCScene scene) : scene_(scene) {}

    void load(const RaySet& set) override {
        set_ = &set;
        hits_.assign(set.rays.size(), {});
    }

    double trace() override {
        const Stopwatch watch;
        parallel_ranges(hits_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            // As Embree's documentation asks of its callers.
            _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
            _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
            for (std::size_t i = begin; i < end; ++i) hits_[i] = trace_one(set_->rays[i]);
        });
        return watch.total();
    }

    std::vector<PackedHit> hits() override { return hits_; }

  private:
    PackedHit trace_one(const PackedRay& ray) {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = set_->kind == "primary" ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
        RTCRayHit query{};
        query.ray = {ray.ox, ray.oy, ray.oz,    0,           ray.dx, ray.dy,
                     ray.dz, 0,      ray.t_max, 0xffffffffu, 0,      0};
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        if (set_->occlusion) {
            rtcOccluded1(scene_, &context, &query.ray);
            const bool occluded = query.ray.tfar < 0;
            return {occluded ? 0 : ray.t_max, 0, 0, occluded ? 0 : WEDGE_NO_PRIMITIVE};
        }
        rtcIntersect1(scene_, &context, &query);
        const bool missed = query.hit.geomID == RTC_INVALID_GEOMETRY_ID;
        return {query.ray.tfar, query.hit.u, query.hit.v,
                missed ? WEDGE_NO_PRIMITIVE : query.hit.primID};
    }

    RTCScene scene_;
    const RaySet* set_ = nullptr;
    std::vector<PackedHit> hits_;
};

class BuiltEmbreeScene : public EmbreeScene {
  public:
    BuiltEmbreeScene(const rendering::FlatScene& flat, BvhQuality quality)
        : device_(rtcNewDevice(nullptr)) {
        rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &device_bytes_);
        scene_ = rtcNewScene(device_);
        rtcSetSceneBuildQuality(scene_, quality == BvhQuality::high ? RTC_BUILD_QUALITY_HIGH
                                                                    : RTC_BUILD_QUALITY_MEDIUM);
        add_triangles(flat);
        const int64_t mesh_bytes = device_bytes_;
        const Stopwatch watch;
        rtcCommitScene(scene_);
        build_s = watch.total();
        bytes = uint64_t(device_bytes_ - mesh_bytes);
    }
    ~BuiltEmbreeScene() override {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    std::unique_ptr<Tracer> make_tracer() override {
        return std::make_unique<EmbreeTracer>(scene_);
    }

  private:
    /// Embree calls this from its threads, with negative sizes for what it gives back.
    static bool count_bytes(void* total, ssize_t bytes, bool) {
        *static_cast<std::atomic<int64_t>*>(total) += bytes;
        return true;
    }

    void add_triangles(const rendering::FlatScene& flat) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* vertices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    sizeof(Vec3), flat.positions.size());
        void* indices =
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                    sizeof(UVec3), flat.triangles.size());
        if (!vertices || !indices)
            throw Error(ErrorKind::internal, "Embree cannot take the scene; is memory short?");
        std::memcpy(vertices, flat.positions.data(), flat.positions.size() * sizeof(Vec3));
        std::memcpy(indices, flat.triangles.data(), flat.triangles.size() * sizeof(UVec3));
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
    }

    std::atomic<int64_t> device_bytes_ = 0;
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace

std::unique_ptr<EmbreeScene> build_embree_scene(const rendering::FlatScene& flat,
                                                BvhQuality quality) {
    return std::make_unique<BuiltEmbreeScene>(flat, quality);
}
#else
std::unique_ptr<EmbreeScene> build_embree_scene(const rendering::FlatScene&, BvhQuality) {
    return nullptr;
}
#endif

}  // namespace wedge::bench
