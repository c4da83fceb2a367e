#include "io/picture_source.h"

#include <OpenImageIO/half.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string_view>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "io/channels.h"
#include "io/readable.h"

namespace aureole::io {
namespace {

// Whether the chunks of a PNG file end with IEND. libpng finds out too, but it also complains on
// the standard error stream, and a library must not print.
bool png_is_cut(const std::string& path) {
    constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
    std::ifstream file(path, std::ios::binary);
    std::array<char, kSignature.size()> bytes{};
    file.read(bytes.data(), bytes.size());
    if (std::string_view(bytes.data(), bytes.size()) != kSignature) return false;  // not PNG
    while (file.read(bytes.data(), bytes.size())) {  // big-endian length, type
        std::uint32_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            length = length << 8U | static_cast<unsigned char>(bytes[i]);
        }
        if (std::string_view(bytes.data() + 4, 4) == "IEND") return false;
        file.seekg(std::streamoff{length} + 4, std::ios::cur);  // data and checksum
    }
    return true;
}

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

// Several decoders report a truncated file and return true all the same.
void check_read(const OIIO::ImageInput& input, const std::string& path, bool success) {
    const std::string message = one_line(input.geterror());
    if (success && message.empty()) return;
    throw FileError(path, "truncated or damaged picture" + (message.empty() ? "" : ": " + message));
}

std::vector<OIIO::ImageSpec> part_specs(OIIO::ImageInput& input) {
    std::vector<OIIO::ImageSpec> specs = {input.spec()};
    // Other formats have pages or icons instead of parts: the first is the picture.
    const bool parts = std::strcmp(input.format_name(), "openexr") == 0;
    for (int p = 1; parts && input.seek_subimage(p, 0); ++p) specs.push_back(input.spec());
    static_cast<void>(input.geterror());  // that there is no part after the last
    return specs;
}

// The first part that names its colour; else the first with pixels that are not deep.
std::size_t choose_part(const std::vector<OIIO::ImageSpec>& specs, const std::string& path) {
    std::size_t first_flat = specs.size();
    for (std::size_t p = 0; p < specs.size(); ++p) {
        if (specs[p].deep) continue;
        if (has_named_color(specs[p].channelnames)) return p;
        first_flat = std::min(first_flat, p);
    }
    if (first_flat == specs.size()) {
        throw FileError(path, "holds deep samples only; flatten it to a picture first");
    }
    return first_flat;
}

void check_size(const OIIO::ImageSpec& spec, const std::string& path) {
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.full_width <= 0 ||
        spec.full_height <= 0) {
        throw FileError(path, "has no pixels: " + std::to_string(spec.width) + "x" +
                                  std::to_string(spec.height) + ", " +
                                  std::to_string(spec.nchannels) + " channels");
    }
    if (spec.depth > 1) {
        throw FileError(path,
                        "is a volume of depth " + std::to_string(spec.depth) + ", not a picture");
    }
}

std::unique_ptr<OIIO::ImageInput> open_input(const std::string& path) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // hand over the values that are in the file
    auto input = OIIO::ImageInput::open(path, &config);
    if (!input) throw FileError(path, "cannot be read as a picture: " + one_line(OIIO::geterror()));
    return input;
}

// One row of one channel, `stride` bytes from pixel to pixel.
void convert_row(const std::byte* from, std::size_t stride, OIIO::TypeDesc type, int width,
                 float* row, std::uint32_t* exact) {
    const auto load = [&]<class T>(T& value, int x) {
        std::memcpy(&value, from + static_cast<std::size_t>(x) * stride, sizeof value);
    };
    for (int x = 0; x < width; ++x) {
        if (type == OIIO::TypeHalf) {
            half value;
            load(value, x);
            row[x] = value;
        } else if (type == OIIO::TypeUInt32) {
            std::uint32_t id = 0;
            load(id, x);
            if (exact != nullptr) exact[x] = id;
            row[x] = static_cast<float>(id);
        } else {
            load(row[x], x);
        }
    }
}

}  // namespace

PictureSource::PictureSource(const std::string& path) : path_(path) {
    check_readable(path);
    if (png_is_cut(path)) throw FileError(path, "truncated picture: its end is missing");
    input_ = open_input(path);
    const std::vector<OIIO::ImageSpec> specs = part_specs(*input_);
    part_ = choose_part(specs, path);
    parts_ = specs.size();
    spec_ = specs[part_];
    check_size(spec_, path);
    exr_ = std::strcmp(input_->format_name(), "openexr") == 0;
    types_.assign(static_cast<std::size_t>(spec_.nchannels), OIIO::TypeFloat);
    if (exr_) spec_.get_channelformats(types_);
}

int PictureSource::rows_at_once(int most) const {
    return spec_.tile_width > 0 ? std::max(1, most / spec_.tile_height) * spec_.tile_height : most;
}

void PictureSource::read(int begin, int end, int first_channel, Image& image, int top,
                         std::vector<std::vector<std::uint32_t>>* ids) {
    const int end_channel = first_channel + image.channels();
    std::vector<std::size_t> offsets;
    std::size_t pixel_bytes = 0;
    for (int c = first_channel; c < end_channel; ++c) {
        offsets.push_back(pixel_bytes);
        pixel_bytes += type(c).size();
    }
    const auto width = static_cast<std::size_t>(spec_.width);
    const auto rows = static_cast<std::size_t>(end - begin);
    buffer_.resize(std::max(buffer_.size(), pixel_bytes * width * rows));
    const OIIO::TypeDesc wanted = exr_ ? OIIO::TypeUnknown : OIIO::TypeFloat;
    const int part = static_cast<int>(part_);
    const bool success =
        spec_.tile_width > 0
            ? input_->read_tiles(part, 0, spec_.x, spec_.x + spec_.width, spec_.y + begin,
                                 spec_.y + end, spec_.z, spec_.z + 1, first_channel, end_channel,
                                 wanted, buffer_.data())
            : input_->read_scanlines(part, 0, spec_.y + begin, spec_.y + end, spec_.z,
                                     first_channel, end_channel, wanted, buffer_.data());
    check_read(*input_, path_, success);

    parallel_for(rows, [&](std::size_t row, int) {
        const int y = top + static_cast<int>(row);
        for (std::size_t c = 0; c < offsets.size(); ++c) {
            std::uint32_t* exact = ids == nullptr || (*ids)[c].empty()
                                       ? nullptr
                                       : (*ids)[c].data() + static_cast<std::size_t>(y) * width;
            const int channel = static_cast<int>(c);
            convert_row(buffer_.data() + row * width * pixel_bytes + offsets[c], pixel_bytes,
                        type(first_channel + channel), spec_.width, image.row(y, channel), exact);
        }
    });
}

}  // namespace aureole::io
