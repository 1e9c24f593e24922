#include "bench/tracers.hpp"
#include "host/base/stopwatch.hpp"
#include "host/device/program.hpp"

namespace wedge::bench {
namespace {

class KernelTracer : public Tracer {
  public:
    KernelTracer(device::Device& device, const rendering::DeviceTree& tree, uint32_t local_size)
        : device_(device), tree_(tree), local_size_(local_size) {
        const device::ProgramRequest request{"kernels/trace.cl", tree.defines};
        const device::Program program =
            std::move(device::build_programs(device, {&request, 1}).front());
        closest_ = program.kernel("trace_closest_rays");
        occluded_ = program.kernel("trace_occluded_rays");
    }

    void load(const RaySet& set) override {
        occlusion_ = set.occlusion;
        count_ = set.rays.size();
        rays_ = device_.upload(std::span<const PackedRay>(set.rays), "rays");
        hits_ = device_.allocate(count_ * sizeof(PackedHit), "hits");
    }

    double trace() override {
        if (count_ == 0) return 0;
        cl::Kernel& kernel = occlusion_ ? occluded_ : closest_;
        cl_uint arg = tree_.set_args(kernel, 0);
        kernel.setArg(arg++, rays_);
        kernel.setArg(arg++, hits_);
        kernel.setArg(arg++, cl_uint(count_));
        const Stopwatch watch;
        device_.launch(kernel, count_, local_size_);
        device_.finish();
        return watch.total();
    }

    std::vector<PackedHit> hits() override {
        std::vector<PackedHit> result(count_);
        if (count_) device_.download(hits_, result.data(), count_ * sizeof(PackedHit));
        return result;
    }

  private:
    device::Device& device_;
    const rendering::DeviceTree& tree_;
    uint32_t local_size_;
    cl::Kernel closest_, occluded_;
    cl::Buffer rays_, hits_;
    bool occlusion_ = false;
    std::size_t count_ = 0;
};

}  // namespace

std::unique_ptr<Tracer> make_kernel_tracer(device::Device& device,
                                           const rendering::DeviceTree& tree, uint32_t local_size) {
    return std::make_unique<KernelTracer>(device, tree, local_size);
}

}  // namespace wedge::bench
