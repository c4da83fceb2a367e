#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <string>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/io/picture.h"
#include "io/atomic_file.h"
#include "io/encode.h"
#include "io/picture_metadata.h"

namespace aureole::io {
namespace {

constexpr int kRowsAtOnce = 256;  // a multiple of the 16 lines that EXR compresses together

struct Format {
    const char* extension;
    const char* encoder;  // OpenImageIO's name
    Encoding encoding;
};

constexpr std::array<Format, 7> kFormats = {{{"exr", "openexr", Encoding::kExr},
                                             {"hdr", "hdr", Encoding::kRgbe},
                                             {"tif", "tiff", Encoding::kFloat},
                                             {"tiff", "tiff", Encoding::kFloat},
                                             {"png", "png", Encoding::kDisplay},
                                             {"jpg", "jpeg", Encoding::kDisplay},
                                             {"jpeg", "jpeg", Encoding::kDisplay}}};

const Format* known_format(const std::string& path) {
    const std::size_t start = path.find_last_of("./");
    std::string extension;
    if (start != std::string::npos && path[start] == '.') extension = path.substr(start + 1);
    for (const Format& format : kFormats) {
        if (OIIO::Strutil::iequals(extension, format.extension)) return &format;
    }
    return nullptr;
}

const Format& format_of(const std::string& path) {
    if (const Format* const format = known_format(path)) return *format;
    throw InvalidArgument("output file", path,
                          "must end in .exr, .hdr, .tif, .tiff, .png, .jpg or .jpeg");
}

// The channels that the format takes, as indices into the picture.
std::vector<int> stored_channels(const Format& format, const Picture& picture) {
    std::vector<int> channels;
    int count = picture.image().channels();
    if (format.encoding == Encoding::kRgbe || format.encoding == Encoding::kDisplay) {
        count = picture.color_channels();
        const bool alpha = std::strcmp(format.encoder, "png") == 0;
        if (alpha && picture.alpha_channel() >= 0) ++count;
    }
    for (int c = 0; c < count; ++c) channels.push_back(c);
    // HDR files always have three.
    if (format.encoding == Encoding::kRgbe && count == 1) channels = {0, 0, 0};
    return channels;
}

OIIO::TypeDesc type_of(const Format& format, const ChannelStorage& storage,
                       const WriteOptions& options) {
    switch (format.encoding) {
        case Encoding::kExr:
            if (storage.type != OIIO::TypeUnknown) return storage.type;
            return options.depth == Depth::kHalf ? OIIO::TypeHalf : OIIO::TypeFloat;
        case Encoding::kDisplay:
            return OIIO::TypeUInt8;
        default:
            return OIIO::TypeFloat;
    }
}

OIIO::ImageSpec make_spec(const Format& format, const Picture& picture,
                          const std::vector<int>& channels, const Window& window,
                          const WriteOptions& options) {
    const PictureMetadata& metadata = PictureAccess::metadata(picture);
    OIIO::ImageSpec spec(window.width, window.height, static_cast<int>(channels.size()),
                         OIIO::TypeFloat);
    spec.channelnames.clear();
    for (const int c : channels) {
        const auto index = static_cast<std::size_t>(c);
        spec.channelnames.push_back(picture.channel_names()[index]);
        spec.channelformats.push_back(type_of(format, metadata.storage[index], options));
    }
    // One common type must be told as the type of the whole.
    const OIIO::TypeDesc first = spec.channelformats.front();
    if (std::all_of(spec.channelformats.begin(), spec.channelformats.end(),
                    [&](OIIO::TypeDesc type) { return type == first; })) {
        spec.set_format(first);
    }
    spec.alpha_channel = -1;
    spec.extra_attribs = metadata.attributes;
    spec.attribute("PixelAspectRatio", static_cast<float>(picture.pixel_aspect_ratio()));
    if (picture.alpha_channel() >= 0 && picture.alpha_channel() < spec.nchannels) {
        spec.alpha_channel = picture.alpha_channel();
    }
    switch (format.encoding) {
        case Encoding::kExr: {
            const Window& display = picture.display_window();
            spec.x = window.x;
            spec.y = window.y;
            spec.full_x = display.x;
            spec.full_y = display.y;
            spec.full_width = display.width;
            spec.full_height = display.height;
            spec.attribute("compression", "zip");
            break;
        }
        case Encoding::kFloat:
            spec.attribute("compression", "zip");
            break;
        case Encoding::kDisplay:
            spec.attribute("oiio:ColorSpace", "sRGB");
            spec.attribute("oiio:UnassociatedAlpha", 1);  // write the values as they are
            if (std::strcmp(format.encoder, "jpeg") == 0) spec.attribute("Compression", "jpeg:95");
            break;
        case Encoding::kRgbe:
            spec.channelnames = {"R", "G", "B"};
            break;
    }
    return spec;
}

// Everything written to memory.
class MemoryFile : public OIIO::Filesystem::IOVecOutput {
  public:
    std::string_view bytes() const {
        return {reinterpret_cast<const char*>(buffer().data()), buffer().size()};
    }
};

std::size_t encode(OIIO::Filesystem::IOProxy& file, const Format& format, const Picture& picture,
                   const WriteOptions& options, const std::string& path) {
    const std::vector<int> channels = stored_channels(format, picture);
    const Window window =
        format.encoding == Encoding::kExr ? picture.data_window() : picture.display_window();
    const OIIO::ImageSpec spec = make_spec(format, picture, channels, window, options);
    const auto fail = [&](const OIIO::ImageOutput& output) {
        std::string reason = output.geterror();
        std::replace(reason.begin(), reason.end(), '\n', ' ');
        throw FileError(path, "cannot be written: " + reason);
    };
    const auto output = OIIO::ImageOutput::create(format.encoder);
    if (!output) throw FileError(path, "cannot be written: " + OIIO::geterror());
    if (!output->set_ioproxy(&file) || !output->open(path, spec)) fail(*output);

    const RowEncoder encoder(picture, format.encoding, channels, spec, window);
    std::vector<std::byte> buffer(encoder.row_bytes() *
                                  static_cast<std::size_t>(std::min(kRowsAtOnce, window.height)));
    std::vector<std::size_t> clipped(static_cast<std::size_t>(window.height));
    for (int begin = 0; begin < window.height; begin += kRowsAtOnce) {
        const int end = std::min(begin + kRowsAtOnce, window.height);
        parallel_for(static_cast<std::size_t>(end - begin), [&](std::size_t row, int) {
            const int y = begin + static_cast<int>(row);
            clipped[static_cast<std::size_t>(y)] =
                encoder.encode(y, buffer.data() + row * encoder.row_bytes());
        });
        if (!output->write_scanlines(spec.y + begin, spec.y + end, 0, OIIO::TypeUnknown,
                                     buffer.data())) {
            fail(*output);
        }
    }
    if (!output->close()) fail(*output);
    std::size_t total = 0;
    for (const std::size_t count : clipped) total += count;
    return total;
}

// The freshly encoded part in its place among those that were not touched.
void write_parts(AtomicFile& file, std::string_view encoded, const OtherParts& others,
                 const std::string& path) {
    std::vector<ExrPart> parts = others.parts;
    const ExrPart& before = parts[others.leader];
    ExrPart leader = split_exr(encoded, path).front();
    for (const char* name : {"name", "view", "timeCode", "chromaticities"}) {
        const ExrAttribute* attribute = before.find(name);
        if (attribute != nullptr && leader.find(name) == nullptr) {
            leader.set(name, attribute->type, attribute->value);
        }
    }
    parts[others.leader] = std::move(leader);
    join_exr(std::move(parts), others.leader,
             [&](std::string_view piece) { file.write(piece.data(), piece.size()); });
}

}  // namespace

bool has_picture_extension(const std::string& path) { return known_format(path) != nullptr; }

void check_picture_extension(const std::string& path) { format_of(path); }

WriteReport write_picture(const std::string& path, const Picture& picture,
                          const WriteOptions& options) {
    const Format& format = format_of(path);
    AtomicFile file(path);
    WriteReport report;
    try {
        const auto& others = PictureAccess::metadata(picture).parts;
        if (format.encoding == Encoding::kExr && others != nullptr) {
            MemoryFile encoded;
            report.clipped_samples = encode(encoded, format, picture, options, path);
            write_parts(file, encoded.bytes(), *others, path);
        } else {
            report.clipped_samples = encode(file, format, picture, options, path);
        }
    } catch (const std::bad_alloc&) {
        throw FileError(path, "there is not enough memory to write it");
    } catch (const FileError&) {
        // A full disk explains more than what the encoder made of it.
        if (file.failure().empty()) throw;
        throw FileError(path, "cannot be written: " + file.failure());
    }
    file.commit();
    return report;
}

}  // namespace aureole::io
