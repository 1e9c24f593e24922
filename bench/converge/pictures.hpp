// Images inside the report: PNG as data URIs.
#pragma once

#include <string>
#include <vector>

#include "wedge/image.hpp"
#include "wedge/render.hpp"

namespace wedge::converge {

/// 8-bit RGB, row 0 at the top.
struct Picture {
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;
};

/// R, G, B of the image as a person sees them: exposure in stops, sRGB.
Picture developed(const Image& image, float exposure);

/// One value per pixel on a dark-to-bright scale; `full` and above is the brightest.
Picture heat_map(const std::vector<double>& values, int width, int height, double full);

/// One value per pixel: blue below, red above, white at 0; `full` is the end of both scales.
Picture signed_map(const std::vector<double>& values, int width, int height, double full);

Picture crop_of(const Picture& picture, const Rect& rect);

/// Mean of boxes of pixels, so that no side is above `largest`.
Picture shrunk(const Picture& picture, int largest);

/// The file's bytes.
std::string png_of(const Picture& picture);

/// `<img …/>`. `pixelated`: shown with hard pixels when enlarged.
std::string img_html(const Picture& picture, const std::string& alt, bool pixelated);

std::string base64(const std::string& bytes);

}  // namespace wedge::converge
