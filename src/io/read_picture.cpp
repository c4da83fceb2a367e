#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <new>
#include <stdexcept>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/io/picture.h"
#include "io/decode.h"
#include "io/picture_metadata.h"
#include "io/picture_source.h"

namespace aureole::io {
namespace {

constexpr int kRowsAtOnce = 256;  // a multiple of the height of every EXR block

struct Pixels {
    Image image;
    std::vector<ChannelStorage> storage;
};

Pixels read_pixels(PictureSource& source) {
    const OIIO::ImageSpec& spec = source.spec();
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    Pixels pixels{Image(spec.width, spec.height, spec.nchannels), {}};
    pixels.storage.resize(channels);
    std::vector<std::vector<std::uint32_t>> ids(channels);
    for (std::size_t c = 0; c < channels; ++c) {
        const OIIO::TypeDesc type = source.type(static_cast<int>(c));
        if (source.is_exr()) pixels.storage[c].type = type;
        if (type == OIIO::TypeUInt32) ids[c].resize(pixels.image.pixels());
    }
    const int rows = source.rows_at_once(kRowsAtOnce);
    for (int begin = 0; begin < spec.height; begin += rows) {
        source.read(begin, std::min(begin + rows, spec.height), 0, pixels.image, begin, &ids);
    }
    for (std::size_t c = 0; c < channels; ++c) {
        if (ids[c].empty()) continue;
        pixels.storage[c].exact =
            std::make_shared<const std::vector<std::uint32_t>>(std::move(ids[c]));
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
    PictureSource source(path);
    const OIIO::ImageSpec& spec = source.spec();
    Pixels pixels = read_pixels(source);
    std::vector<std::string> names = spec.channelnames;
    if (!source.is_exr()) {
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
    if (source.parts() > 1) metadata.parts = read_other_parts(path, source.part());
    if (source.is_exr()) {
        picture.set_data_origin(spec.x, spec.y);
        picture.set_display_window({spec.full_x, spec.full_y, spec.full_width, spec.full_height});
    }
    const float aspect = spec.get_float_attribute("PixelAspectRatio", 1.0F);
    if (aspect > 0) picture.set_pixel_aspect_ratio(double{aspect});
    return picture;
}

}  // namespace

Picture read_picture(const std::string& path) {
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
