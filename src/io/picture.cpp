#include "aureole/io/picture.h"

#include <algorithm>
#include <set>
#include <utility>

#include "aureole/base/error.h"
#include "io/channels.h"
#include "io/picture_metadata.h"

namespace aureole::io {
namespace {

std::vector<std::string> default_names(int channels) {
    std::vector<std::string> names = channels <= 2 ? std::vector<std::string>{"Y", "A"}
                                                   : std::vector<std::string>{"R", "G", "B", "A"};
    for (int c = 4; c < channels; ++c) names.push_back("channel" + std::to_string(c));
    names.resize(static_cast<std::size_t>(channels));
    return names;
}

void check_names(const std::vector<std::string>& names, int channels) {
    if (names.size() != static_cast<std::size_t>(channels)) {
        throw InvalidArgument("channel names", std::to_string(names.size()),
                              "there are " + std::to_string(channels) + " channels to name");
    }
    std::set<std::string_view> seen;
    for (const std::string& name : names) {
        if (name.empty()) throw InvalidArgument("channel name", "\"\"", "must not be empty");
        if (!seen.insert(name).second) {
            throw InvalidArgument("channel name", name, "must not be used twice");
        }
    }
}

}  // namespace

Picture::Picture(Image image, std::vector<std::string> channel_names)
    : image_(std::move(image)),
      channel_names_(channel_names.empty() ? default_names(image_.channels())
                                           : std::move(channel_names)),
      display_window_{0, 0, image_.width(), image_.height()} {
    if (image_.empty()) throw InvalidArgument("picture", "empty", "must have pixels");
    check_names(channel_names_, image_.channels());

    const ColorChannels found = find_color_channels(channel_names_);
    color_channels_ = static_cast<int>(found.color.size());
    if (found.alpha >= 0) alpha_channel_ = color_channels_;
    std::vector<int> order = found.color;
    if (found.alpha >= 0) order.push_back(found.alpha);
    for (int c = 0; c < image_.channels(); ++c) {
        if (std::find(order.begin(), order.end(), c) == order.end()) order.push_back(c);
    }
    if (!std::is_sorted(order.begin(), order.end())) {
        Image sorted(image_.width(), image_.height(), image_.channels());
        std::vector<std::string> names;
        for (int c = 0; c < sorted.channels(); ++c) {
            const int from = order[static_cast<std::size_t>(c)];
            std::copy_n(image_.plane(from), image_.pixels(), sorted.plane(c));
            names.push_back(channel_names_[static_cast<std::size_t>(from)]);
        }
        image_ = std::move(sorted);
        channel_names_ = std::move(names);
    }
    auto metadata = std::make_shared<PictureMetadata>();
    metadata->storage.resize(channel_names_.size());
    metadata_ = std::move(metadata);
}

PictureMetadata& Picture::own_metadata() {
    auto copy = std::make_shared<PictureMetadata>(*metadata_);
    PictureMetadata& result = *copy;
    metadata_ = std::move(copy);
    return result;
}

ImageView Picture::color() noexcept { return image_.view().channel_range(0, color_channels_); }

ConstImageView Picture::color() const noexcept {
    return image_.view().channel_range(0, color_channels_);
}

void Picture::append_layer(const std::string& layer, const ConstImageView& channels) {
    if (layer.empty()) throw InvalidArgument("layer name", "\"\"", "must not be empty");
    std::vector<std::string> names;
    for (int c = 0; c < color_channels_; ++c) {
        names.push_back(layer + "." + base_of(channel_names_[static_cast<std::size_t>(c)]));
    }
    append_channels(names, channels);
}

void Picture::append_channels(const std::vector<std::string>& names,
                              const ConstImageView& channels) {
    if (channels.width != image_.width() || channels.height != image_.height()) {
        throw InvalidArgument(
            "size of appended channels",
            std::to_string(channels.width) + "x" + std::to_string(channels.height),
            "must be that of the picture, " + std::to_string(image_.width()) + "x" +
                std::to_string(image_.height()));
    }
    check_names(names, channels.channels);
    std::vector<std::string> all = channel_names_;
    all.insert(all.end(), names.begin(), names.end());
    check_names(all, image_.channels() + channels.channels);

    Image grown(image_.width(), image_.height(), image_.channels() + channels.channels);
    std::copy_n(image_.plane(0), image_.pixels() * static_cast<std::size_t>(image_.channels()),
                grown.plane(0));
    for (int c = 0; c < channels.channels; ++c) {
        for (int y = 0; y < channels.height; ++y) {
            float* row = grown.row(y, image_.channels() + c);
            for (int x = 0; x < channels.width; ++x) row[x] = channels.at(x, y, c);
        }
    }
    own_metadata().storage.resize(all.size());
    image_ = std::move(grown);
    channel_names_ = std::move(all);
}

Window Picture::data_window() const noexcept {
    return {data_x_, data_y_, image_.width(), image_.height()};
}

void Picture::set_data_origin(int x, int y) noexcept {
    data_x_ = x;
    data_y_ = y;
}

void Picture::set_display_window(const Window& window) {
    if (window.width <= 0 || window.height <= 0) {
        throw InvalidArgument("display window",
                              std::to_string(window.width) + "x" + std::to_string(window.height),
                              "width and height must be positive");
    }
    display_window_ = window;
}

void Picture::set_pixel_aspect_ratio(double ratio) {
    if (!(ratio > 0)) {
        throw InvalidArgument("pixel aspect ratio", std::to_string(ratio), "must be positive");
    }
    pixel_aspect_ratio_ = ratio;
}

std::optional<float> Picture::float_attribute(const std::string& name) const {
    const auto at = metadata_->attributes.find(name);
    if (at == metadata_->attributes.end() || at->type().is_array() ||
        at->type().aggregate != OIIO::TypeDesc::SCALAR ||
        at->type().basetype == OIIO::TypeDesc::STRING) {
        return std::nullopt;
    }
    return at->get_float();
}

std::optional<std::string> Picture::string_attribute(const std::string& name) const {
    const auto at = metadata_->attributes.find(name);
    if (at == metadata_->attributes.end() || at->type() != OIIO::TypeString) return std::nullopt;
    return at->get_string();
}

std::vector<std::string> Picture::attribute_names() const {
    std::vector<std::string> names;
    for (const OIIO::ParamValue& value : metadata_->attributes)
        names.push_back(value.name().string());
    return names;
}

void Picture::set_attribute(const std::string& name, float value) {
    own_metadata().attributes.attribute(name, value);
}

void Picture::set_attribute(const std::string& name, const std::string& value) {
    own_metadata().attributes.attribute(name, value);
}

void Picture::erase_attribute(const std::string& name) { own_metadata().attributes.remove(name); }

int Picture::other_parts() const noexcept {
    return metadata_->parts ? static_cast<int>(metadata_->parts->parts.size()) - 1 : 0;
}

}  // namespace aureole::io
