#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/io/picture.h"
#include "io/channels.h"
#include "io/decode.h"
#include "io/picture_metadata.h"

namespace aureole::io {
namespace fs = std::filesystem;
namespace {

constexpr int kRowsAtOnce = 256;  // a multiple of the height of every EXR block

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

void check_readable(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) throw FileError(path, "is a folder, not a picture");
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        if (errno == ENOENT) throw FileError(path, "there is no such file");
        throw FileError(path, std::string("cannot be read: ") + std::strerror(errno));
    }
    ::close(descriptor);
    if (fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) == 0) {
        throw FileError(path, "is empty (0 bytes)");
    }
    if (png_is_cut(path)) throw FileError(path, "truncated picture: its end is missing");
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

// Rows [begin, end) of the part, in the types of the file, pixel by pixel.
void read_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int part, int begin, int end,
               OIIO::TypeDesc type, std::vector<std::byte>& buffer, const std::string& path) {
    const bool success =
        spec.tile_width > 0
            ? input.read_tiles(part, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1,
                               0, spec.nchannels, type, buffer.data())
            : input.read_scanlines(part, 0, begin, end, spec.z, 0, spec.nchannels, type,
                                   buffer.data());
    check_read(input, path, success);
}

struct Pixels {
    Image image;
    std::vector<ChannelStorage> storage;
};

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
            load(exact[x], x);
            row[x] = static_cast<float>(exact[x]);
        } else {
            load(row[x], x);
        }
    }
}

// EXR samples come in their own types, because OpenImageIO scales integers to [0, 1] and the uint
// channels of EXR are ids; other formats as the float that OpenImageIO makes of them.
Pixels read_pixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int part, bool exr,
                   const std::string& path) {
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<OIIO::TypeDesc> types(channels, OIIO::TypeFloat);
    if (exr) spec.get_channelformats(types);
    std::vector<std::size_t> offsets(channels);
    std::size_t pixel_bytes = 0;
    for (std::size_t c = 0; c < channels; ++c) {
        offsets[c] = pixel_bytes;
        pixel_bytes += types[c].size();
    }

    Pixels pixels{Image(spec.width, spec.height, spec.nchannels), {}};
    pixels.storage.resize(channels);
    std::vector<std::vector<std::uint32_t>> exact(channels);
    for (std::size_t c = 0; c < channels; ++c) {
        if (exr) pixels.storage[c].type = types[c];
        if (types[c] == OIIO::TypeUInt32) exact[c].resize(pixels.image.pixels());
    }

    const int rows = spec.tile_width > 0
                         ? std::max(1, kRowsAtOnce / spec.tile_height) * spec.tile_height
                         : kRowsAtOnce;
    const auto width = static_cast<std::size_t>(spec.width);
    std::vector<std::byte> buffer(pixel_bytes * width *
                                  static_cast<std::size_t>(std::min(rows, spec.height)));
    for (int begin = 0; begin < spec.height; begin += rows) {
        const int end = std::min(begin + rows, spec.height);
        read_rows(input, spec, part, spec.y + begin, spec.y + end,
                  exr ? OIIO::TypeUnknown : OIIO::TypeFloat, buffer, path);
        parallel_for(static_cast<std::size_t>(end - begin), [&](std::size_t row, int) {
            const int y = begin + static_cast<int>(row);
            for (std::size_t c = 0; c < channels; ++c) {
                std::uint32_t* ids = exact[c].empty()
                                         ? nullptr
                                         : exact[c].data() + static_cast<std::size_t>(y) * width;
                convert_row(buffer.data() + row * width * pixel_bytes + offsets[c], pixel_bytes,
                            types[c], spec.width, pixels.image.row(y, static_cast<int>(c)), ids);
            }
        });
    }
    for (std::size_t c = 0; c < channels; ++c) {
        if (exact[c].empty()) continue;
        pixels.storage[c].exact =
            std::make_shared<const std::vector<std::uint32_t>>(std::move(exact[c]));
    }
    return pixels;
}

// What describes the picture, without what describes how it was stored.
OIIO::ParamValueList picture_attributes(const OIIO::ImageSpec& spec) {
    static const char* const kStorage[] = {"compression", "planarconfig",     "name",
                                           "Orientation", "PixelAspectRatio", "ICCProfile"};
    static const char* const kPrefixes[] = {
        "oiio:", "openexr:", "tiff:", "png:", "jpeg:", "hdr:", "ICCProfile:"};
    OIIO::ParamValueList result;
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        const std::string name = attribute.name().string();
        const auto is_name = [&](const char* other) { return name == other; };
        const auto has_prefix = [&](const char* prefix) {
            return name.compare(0, std::strlen(prefix), prefix) == 0;
        };
        if (std::any_of(std::begin(kStorage), std::end(kStorage), is_name)) continue;
        if (std::any_of(std::begin(kPrefixes), std::end(kPrefixes), has_prefix)) continue;
        result.push_back(attribute);
    }
    return result;
}

std::shared_ptr<const OtherParts> read_other_parts(const std::string& path, std::size_t leader) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
    auto others = std::make_shared<OtherParts>();
    others->leader = leader;
    others->parts = split_exr(bytes, path);
    if (leader >= others->parts.size()) {
        throw FileError(path, "truncated or damaged picture: parts are missing");
    }
    others->parts[leader].chunks.clear();
    return others;
}

Picture read(const std::string& path) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // hand over the values that are in the file
    const auto input = OIIO::ImageInput::open(path, &config);
    if (!input) throw FileError(path, "cannot be read as a picture: " + one_line(OIIO::geterror()));
    const std::vector<OIIO::ImageSpec> specs = part_specs(*input);
    const std::size_t part = choose_part(specs, path);
    const OIIO::ImageSpec& spec = specs[part];
    check_size(spec, path);

    const bool exr = std::strcmp(input->format_name(), "openexr") == 0;
    Pixels pixels = read_pixels(*input, spec, static_cast<int>(part), exr, path);
    std::vector<std::string> names = spec.channelnames;
    if (!exr) {
        linearize(spec, find_color_channels(names), pixels.image);
        pixels.image = upright(std::move(pixels.image), spec.get_int_attribute("Orientation", 1));
    }

    // Picture sorts its channels, and storage must follow them.
    std::vector<std::pair<std::string, ChannelStorage>> storage;
    for (std::size_t c = 0; c < names.size(); ++c)
        storage.emplace_back(names[c], pixels.storage[c]);
    Picture picture(std::move(pixels.image), std::move(names));
    PictureMetadata& metadata = PictureAccess::own_metadata(picture);
    for (std::size_t c = 0; c < storage.size(); ++c) {
        // The colour is stored as the caller of write_picture() wishes.
        if (static_cast<int>(c) < picture.color_channels()) continue;
        const std::string& name = picture.channel_names()[c];
        metadata.storage[c] = std::find_if(storage.begin(), storage.end(), [&](const auto& entry) {
                                  return entry.first == name;
                              })->second;
    }
    metadata.attributes = picture_attributes(spec);
    if (specs.size() > 1) metadata.parts = read_other_parts(path, part);
    if (exr) {
        picture.set_data_origin(spec.x, spec.y);
        picture.set_display_window({spec.full_x, spec.full_y, spec.full_width, spec.full_height});
    }
    const float aspect = spec.get_float_attribute("PixelAspectRatio", 1.0F);
    if (aspect > 0) picture.set_pixel_aspect_ratio(double{aspect});
    return picture;
}

}  // namespace

Picture read_picture(const std::string& path) {
    check_readable(path);
    try {
        return read(path);
    } catch (const std::bad_alloc&) {
        throw FileError(path, "there is not enough memory to read it");
    } catch (const std::length_error&) {
        throw FileError(path, "is too large to read");
    } catch (const InvalidArgument& error) {  // repeated or empty channel names
        throw FileError(path, std::string("cannot be used: ") + error.what());
    }
}

}  // namespace aureole::io
