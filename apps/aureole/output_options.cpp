#include "output_options.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

#include "aureole/base/error.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const std::string& path) {
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace

void OutputOptions::add_options(CLI::App& command, const std::string& description) {
    option_ = command.add_option("-o,--output", paths_, description)
                  ->required()
                  ->type_name("FILE")
                  ->expected(1)
                  ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    one_of(command.add_option("--depth", depth_,
                              "Of EXR colour channels; half loses the wings of glare"),
           {"float", "half"})
        ->capture_default_str();
}

void OutputOptions::check_depth(const std::vector<std::string>& files) const {
    if (depth_ == "half" && std::none_of(files.begin(), files.end(), is_exr_file)) {
        throw InvalidArgument("--depth", depth_, "applies to EXR, and no EXR is written");
    }
}

void OutputOptions::write(const std::string& path, const io::Picture& picture,
                          Session& session) const {
    io::WriteOptions options;
    options.depth = depth_ == "half" ? io::Depth::kHalf : io::Depth::kFloat;
    const io::WriteReport report = io::write_picture(path, picture, options);
    if (report.clipped_samples > 0) {
        session.note(fmt::format("{}: {} samples do not fit its format and were clipped", path,
                                 report.clipped_samples));
    }
}

void check_outputs(const std::vector<std::string>& files) {
    std::set<fs::path> seen;
    for (const std::string& file : files) {
        io::check_picture_extension(file);
        check_folder(file);
        if (!seen.insert(fs::absolute(file).lexically_normal()).second) {
            throw InvalidArgument("output file", file, "would be written more than once");
        }
    }
}

void check_folder(const std::string& path) {
    fs::path folder = fs::path(path).parent_path();
    if (folder.empty()) folder = ".";
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored)) {
        throw FileError(path, "cannot be written: there is no folder " + folder.string());
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
        throw FileError(
            path, "cannot be written in folder " + folder.string() + ": " + std::strerror(errno));
    }
}

bool is_display_file(const std::string& path) {
    const std::string extension = lower_extension(path);
    return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

bool is_exr_file(const std::string& path) { return lower_extension(path) == ".exr"; }

io::Picture display_picture(const Image& encoded, const io::Picture& original) {
    io::Picture picture(encoded);
    picture.set_data_origin(original.data_window().x, original.data_window().y);
    picture.set_display_window(original.display_window());
    picture.set_pixel_aspect_ratio(original.pixel_aspect_ratio());
    return picture;
}

Image over_display_window(const ConstImageView& image, const io::Picture& picture) {
    const io::Window display = picture.display_window();
    const io::Window data = picture.data_window();
    Image seen(display.width, display.height, image.channels);
    const int left = std::max(display.x, data.x);
    const int right = std::min(display.x + display.width, data.x + data.width);
    const int top = std::max(display.y, data.y);
    const int bottom = std::min(display.y + display.height, data.y + data.height);
    for (int c = 0; c < image.channels; ++c) {
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) {
                seen.at(x - display.x, y - display.y, c) = image.at(x - data.x, y - data.y, c);
            }
        }
    }
    return seen;
}

Image side_by_side(const ConstImageView& before, const ConstImageView& after) {
    constexpr int kLine = 4;  // pixels of white between the two
    Image both(2 * before.width + kLine, before.height, before.channels);
    for (int c = 0; c < before.channels; ++c) {
        for (int y = 0; y < before.height; ++y) {
            float* out = both.row(y, c);
            for (int x = 0; x < before.width; ++x) {
                out[x] = before.at(x, y, c);
                out[before.width + kLine + x] = after.at(x, y, c);
            }
            std::fill(out + before.width, out + before.width + kLine, 1.0F);
        }
    }
    return both;
}

}  // namespace aureole::app
