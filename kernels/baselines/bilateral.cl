// Cross-bilateral filter (Eisemann and Durand 2004; Petschnigg et al. 2004): a Gaussian that stops at
// edges of geometry, which are free of noise. Light itself does not stop it.
#include "baselines/layers.clh"

#define SIGMA_PX 4.0f
#define RADIUS_PX 8
#define SIGMA_NORMAL 0.2f
#define SIGMA_PLANE_PX 1.0f

__kernel void bilateral(const int width, const int height, __global const float4* light,
                        __global const float4* surface, __global const float4* place,
                        const int pass_number, __global float4* out) {
    const int i = get_global_id(0);
    if (i >= width * height) return;
    if (!is_hit(surface[i])) {
        out[i] = light[i];
        return;
    }
    const int x = i % width, y = i / width;
    const float4 n = surface[i], p = place[i];
    float4 sum = 0;
    float weights = 0;
    for (int v = -RADIUS_PX; v <= RADIUS_PX; ++v)
        for (int u = -RADIUS_PX; u <= RADIUS_PX; ++u) {
            if (!is_inside(x + u, y + v, width, height)) continue;
            const int j = i + v * width + u;
            if (!is_hit(surface[j])) continue;
            const float spatial = (u * u + v * v) / square(SIGMA_PX);
            const float normal = square3(surface[j] - n) / square(SIGMA_NORMAL);
            const float plane = square(pixels_off_plane(n, p, place[j]) / SIGMA_PLANE_PX);
            const float w = exp(-0.5f * (spatial + normal + plane));
            sum += w * light[j];
            weights += w;
        }
    out[i] = sum / weights;
}
