// The whole of it on a small scene: resuming, the report, a browser.
#include "bench/converge/session.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "bench/converge/pictures.hpp"
#include "tests/bench/approx.hpp"
#include "tests/bench/temporary_folder.hpp"
#include "wedge/image_io.hpp"

using namespace wedge;
using namespace wedge::converge;
using test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

Config small_config(const fs::path& folder) {
    Config config;
    config.scenes = {std::string(WEDGE_SOURCE_DIR) + "/scenes/grids.json"};
    config.methods = {"mc-sobol", "mc-hash", "aaf"};
    config.budgets = {{1, 2}, {0.5}, {}};
    config.seeds = 2;
    config.size = "32";
    config.reference_spp = 64;
    config.folder = folder / "out";
    config.command = "wedge bench converge <small> & \"quoted\"";
    complete(config);
    return config;
}

Outcome run(const Config& config) {
    return converge::converge(config, {}, config.folder / "tables.md", [](const std::string&) {});
}

/// What stops it from being XML, as far as elements go; empty if nothing does.
std::string first_fault(const std::string& html) {
    std::vector<std::string> open;
    for (std::size_t at = 0; (at = html.find('<', at)) != html.npos;) {
        if (html.compare(at, 2, "<!") == 0) {
            at = html.find('>', at);
            continue;
        }
        const std::size_t end = html.find('>', at);
        if (end == html.npos) return "an element has no end";
        const std::string tag = html.substr(at + 1, end - at - 1);
        if (tag.find('<') != tag.npos) return "< inside of <" + tag;
        const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
        at = end;
        if (tag[0] == '/') {
            if (open.empty() || "/" + open.back() != tag) return "unexpected <" + tag + ">";
            open.pop_back();
        } else if (tag.back() != '/') {
            open.push_back(name);
            if (name == "style") at = html.find("</style>", at);
        }
    }
    return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

/// One report for all tests of it.
const std::string& report_text() {
    static const std::string text = [] {
        const TemporaryFolder folder;
        return read_text(run(small_config(folder.path())).report);
    }();
    return text;
}

std::string find_chromium() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
        const std::string command = std::string("command -v ") + name + " > /dev/null 2>&1";
        if (std::system(command.c_str()) == 0) return name;
    }
    return "";
}

/// What Chromium prints or writes with these arguments.
std::string browse(const TemporaryFolder& folder, const std::string& arguments) {
    const std::string out = (folder / "stdout").string();
    const std::string command =
        "timeout 60 " + find_chromium() +
        " --headless=new --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir='" +
        (folder / "profile").string() + "' " + arguments + " > '" + out + "' 2> '" +
        (folder / "stderr").string() + "'";
    CHECK(std::system(command.c_str()) == 0);
    return read_text(out);
}

/// Lines that Chromium's console shows of a page: scripts that fail, resources that are missing.
std::size_t console_lines(const TemporaryFolder& folder, const std::string& html) {
    std::ofstream(folder / "page.html") << html;
    browse(folder, "--enable-logging=stderr --virtual-time-budget=5000 --dump-dom 'file://" +
                       (folder / "page.html").string() + "'");
    const std::string log = read_text(folder / "stderr");
    std::size_t lines = 0;
    for (std::size_t at = 0; (at = log.find("CONSOLE", at)) != log.npos; ++at) ++lines;
    return lines;
}

}  // namespace

TEST_CASE("a_killed_session_goes_on_where_it_was") {
    const TemporaryFolder folder;
    const Config config = small_config(folder.path());
    run(config);
    const fs::path list = config.folder / "runs.jsonl";
    const std::string whole = read_text(list);
    const auto before = read_lines(list);
    REQUIRE(before.size() == 10);  // 2 seeds x (2 + 2 + 1)

    // Killed while the fifth record was being written.
    std::size_t end = 0;
    for (int line = 0; line < 4; ++line) end = whole.find('\n', end) + 1;
    fs::resize_file(list, end + 40);
    run(config);
    const auto after = read_lines(list);
    REQUIRE(after.size() == before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        CHECK(after[i]["key"] == before[i]["key"]);
        // The same seeds: the same images, but times of their own.
        CHECK(after[i]["rays"] == before[i]["rays"]);
        if (i < 4) CHECK(after[i] == before[i]);
    }

    // Nothing is left to do; another budget adds what is missing only.
    run(config);
    CHECK(read_lines(list).size() == before.size());
    Config more = config;
    more.budgets.spp.push_back(4);
    run(more);
    CHECK(read_lines(list).size() == before.size() + 4);
}

TEST_CASE("a_reference_takes_more_samples_without_losing_those_it_has") {
    const TemporaryFolder folder;
    Scene scene = load_scene(std::string(WEDGE_SOURCE_DIR) + "/scenes/grids.json", {});
    scene.film = {24, 18};
    ReferenceRequest request;
    request.folder = folder.path();
    request.name = "grids";
    request.scene_digest = "digest";
    request.spp = 512;
    const Reference first = make_reference(scene, request);
    CHECK(first.spp == 512);
    request.spp = 1024;
    const Reference more = make_reference(scene, request);
    CHECK(more.spp == 1024);
    CHECK(more.id != first.id);
    // Twice the samples, half the error; not so if seeds came again.
    const double ratio = mean_squared_error_of(more) / mean_squared_error_of(first);
    CHECK(ratio > 0.3);
    CHECK(ratio < 0.75);
    // All at once gives the same, up to the rounding of the file in between.
    const TemporaryFolder other;
    request.folder = other.path();
    const Reference whole = make_reference(scene, request);
    for (std::size_t i = 0; i < whole.mean.pixels.size(); ++i)
        CHECK(more.mean.pixels[i] == test::close_to(whole.mean.pixels[i], 1e-5));
    request.spp = 512;
    CHECK(make_reference(scene, request).spp == 1024);
}

TEST_CASE("report_is_well_formed") {
    CHECK(first_fault(report_text()) == "");
    CHECK(first_fault("<p><b>text</p></b>") != "");
    CHECK(report_text().find("&lt;small&gt; &amp; &quot;quoted&quot;") != std::string::npos);
}

TEST_CASE("report_needs_nothing_but_itself") {
    const std::string& html = report_text();
    for (const char* outside : {"http:", "https:", "//cdn", "<script", "<link", "@import", "url(",
                                "src=\"/", "file:", "<iframe", "onload"}) {
        CAPTURE(outside);
        CHECK(html.find(outside) == std::string::npos);
    }
    std::size_t sources = 0;
    for (std::size_t at = 0; (at = html.find("src=\"", at)) != html.npos; ++at, ++sources)
        CHECK(html.compare(at, 27, "src=\"data:image/png;base64,") == 0);
    CHECK(sources > 8);
    for (std::size_t at = 0; (at = html.find("href=\"", at)) != html.npos; ++at)
        CHECK(html[at + 6] == '#');
}

/// Letters of encoded pictures may spell anything.
std::string without_pictures(const std::string& html) {
    std::string words;
    std::size_t from = 0, at;
    while ((at = html.find("base64,", from)) != std::string::npos) {
        words += html.substr(from, at - from);
        from = html.find('"', at);
    }
    return words + html.substr(from);
}

TEST_CASE("report_says_what_was_measured_and_how") {
    const std::string& html = report_text();
    for (const char* part :
         {"<svg viewBox", "mc-hash", "aaf", "RMSE", "relMSE", "FLIP", "SSIM", "bias²", "blocks",
          "compiling kernels", "building the BVH", "driver", "wedge render", "slope", "worst"}) {
        CAPTURE(part);
        CHECK(html.find(part) != std::string::npos);
    }
    const std::string words = without_pictures(html);
    CHECK(words.size() > 10000);
    CHECK(words.size() < html.size());
    for (const char* none : {"nan", "inf\""}) {
        const std::size_t at = words.find(none);
        CAPTURE(words.substr(at < 40 ? 0 : std::min(at - 40, words.size()), 80));
        CHECK(at == std::string::npos);
    }
}

TEST_CASE("pictures_are_encoded_as_rfc_4648_says") {
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foobar") == "Zm9vYmFy");
}

TEST_CASE("report_shows_in_a_browser_light_and_dark") {
    if (find_chromium().empty()) {
        MESSAGE("report_shows_in_a_browser_light_and_dark is skipped: there is no Chromium");
        return;
    }
    const TemporaryFolder folder;
    std::ofstream(folder / "report.html") << report_text();
    double brightness[2];
    for (const int dark : {0, 1}) {
        const std::string png = (folder / (dark ? "dark.png" : "light.png")).string();
        browse(folder, "--window-size=900,1400 --blink-settings=preferredColorScheme=" +
                           std::string(dark ? "0" : "1") + " '--screenshot=" + png + "' 'file://" +
                           (folder / "report.html").string() + "'");
        const Image shot = read_image(png);
        CHECK(shot.width == 900);
        double sum = 0, squares = 0;
        for (float v : shot.pixels) {
            sum += v;
            squares += v * v;
        }
        const double n = double(shot.pixels.size());
        brightness[dark] = sum / n;
        CHECK(squares / n - brightness[dark] * brightness[dark] > 1e-3);  // not an empty page
    }
    CHECK(brightness[0] > 0.6);
    CHECK(brightness[1] < 0.3);
}

TEST_CASE("report_renders_its_text_and_nothing_on_the_console") {
    if (find_chromium().empty()) {
        MESSAGE(
            "report_renders_its_text_and_nothing_on_the_console is skipped: there is no Chromium");
        return;
    }
    const TemporaryFolder folder;
    CHECK(console_lines(folder, "<script>console.error('seen')</script>") == 1);
    CHECK(console_lines(folder, report_text()) == 0);
    // What is laid out, not what is in the file: only the test needs a script.
    std::ofstream(folder / "report.html") << report_text();
    std::ofstream(folder / "text.html")
        << "<iframe id='f' src='report.html' style='width:900px;height:700px'></iframe><pre></pre>"
           "<script>window.onload=()=>{document.querySelector('pre').textContent="
           "document.getElementById('f').contentDocument.body.innerText}</script>";
    const std::string text = browse(
        folder, "--allow-file-access-from-files --virtual-time-budget=5000 --dump-dom 'file://" +
                    (folder / "text.html").string() + "'");
    for (const char* part : {"Error against time", "Summary", "grids", "mc-hash", "Equal time",
                             "How it was measured", "samples a pixel"}) {
        CAPTURE(part);
        CHECK(text.find(part) != std::string::npos);
    }
}

TEST_CASE("report_is_no_wider_than_a_phone") {
    if (find_chromium().empty()) {
        MESSAGE("report_is_no_wider_than_a_phone is skipped: there is no Chromium");
        return;
    }
    const TemporaryFolder folder;
    // A frame of the width of a phone, because windows have a least width; only the test needs a
    // script, which asks how wide the page has become.
    std::ofstream(folder / "report.html") << report_text();
    std::ofstream(folder / "phone.html")
        << "<iframe id='f' src='report.html' style='width:375px;height:700px;border:0'></iframe>"
           "<script>window.onload=()=>{document.title='width '+document.getElementById('f')"
           ".contentDocument.documentElement.scrollWidth+' px'}</script>";
    const std::string page = browse(
        folder, "--allow-file-access-from-files --virtual-time-budget=5000 --dump-dom 'file://" +
                    (folder / "phone.html").string() + "'");
    CHECK_MESSAGE(page.find("width 375 px") != std::string::npos,
                  page.substr(0, page.find("</title>")));
}
