// Uses the library as a stranger would: loads an installed scene, renders it small, looks at the
// pixels, writes them.
#include <wedge/error.hpp>
#include <wedge/image_io.hpp>
#include <wedge/render.hpp>
#include <wedge/scene.hpp>

#include <cmath>
#include <cstdio>

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    try {
        wedge::Scene scene = wedge::load_scene(argv[1]);
        scene.film = {32, 24};
        wedge::RenderOptions options;
        options.samples_per_pixel = 4;
        options.bounces = 0;
        const wedge::Frame frame = wedge::render(scene, options);

        wedge::write_exr(argv[2], frame.image);

        double sum = 0;
        for (int y = 0; y < frame.image.height; ++y)
            for (int x = 0; x < frame.image.width; ++x)
                sum += frame.image.at(x, y, frame.image.channel("G"));
        const double mean = sum / (32 * 24);
        std::printf("%s: %zu meshes, mean radiance %g, rendered on %s\n", scene.name.c_str(),
                    scene.meshes.size(), mean, frame.stats.device.name.c_str());
        return std::isfinite(mean) && mean > 0 ? 0 : 1;
    } catch (const wedge::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return int(error.kind());
    }
}
