// Edge-avoiding a-trous wavelets: Dammertz, Sewtz, Hanika, Lensch 2010, "Edge-Avoiding A-Trous Wavelet
// Transform for fast Global Illumination Filtering", High Performance Graphics. Equation 6 with the
// weights of section 3; scales made relative, so that neither units nor exposure matter: colour to
// the brightness of the two pixels, position to the width of a pixel.
#include "baselines/layers.clh"

#define SIGMA_COLOUR 1.0f  // at the first level; halved at each (section 3.1)
#define SIGMA_NORMAL 0.3f
#define SIGMA_PLACE_PX 1.0f

__kernel void atrous(const int width, const int height, __global const float4* light,
                     __global const float4* surface, __global const float4* place,
                     const int pass_number, __global float4* out) {
    const int i = get_global_id(0);
    if (i >= width * height) return;
    if (!is_hit(surface[i])) {
        out[i] = light[i];
        return;
    }
    const float spline[3] = {3.0f / 8, 1.0f / 4, 1.0f / 16};  // B3, from the middle
    const int step = 1 << pass_number;
    const float sigma_colour = SIGMA_COLOUR / step;
    const int x = i % width, y = i / width;
    const float4 c = light[i], n = surface[i], p = place[i];
    float4 sum = 0;
    float weights = 0;
    for (int v = -2; v <= 2; ++v)
        for (int u = -2; u <= 2; ++u) {
            if (!is_inside(x + u * step, y + v * step, width, height)) continue;
            const int j = i + v * step * width + u * step;
            if (!is_hit(surface[j])) continue;
            const float brightness = luminance_of(fabs(c)) + luminance_of(fabs(light[j]));
            const float colour =
                square3(light[j] - c) / square(sigma_colour * fmax(brightness, FLT_MIN));
            const float normal = square3(surface[j] - n) / square(SIGMA_NORMAL);
            const float plane = square(pixels_off_plane(n, p, place[j]) / (SIGMA_PLACE_PX * step));
            const float w =
                spline[abs(u)] * spline[abs(v)] * exp(-fmin(colour + normal + plane, 80.0f));
            sum += w * light[j];
            weights += w;
        }
    out[i] = sum / weights;
}
