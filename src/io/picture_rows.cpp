#include "aureole/io/picture_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>

#include "aureole/base/error.h"
#include "io/decode.h"
#include "io/picture_source.h"

namespace aureole::io {
namespace {

constexpr int kRowsAtOnce = 32;  // the height of most EXR blocks and of the TIFF strips we write

// Decoders' ways to say that memory is short, or a size absurd, in the words of this module.
template <class Action>
auto with_file_errors(const std::string& path, const Action& action) {
    try {
        return action();
    } catch (const std::bad_alloc&) {
        throw FileError(path, "there is not enough memory to read it");
    } catch (const std::length_error&) {
        throw FileError(path, "is too large to read");
    }
}

}  // namespace

struct PictureRows::Impl {
    explicit Impl(const std::string& path) : source(path) {}

    void load(int row);

    PictureSource source;
    std::optional<Picture> turned;  // the whole, if an orientation turns it
    ColorChannels channels;         // as places in `band`
    int first_channel = 0;          // of the file, of `band`
    int band_channels = 0;
    Image band;  // decoded rows [band_begin, band_end) of the file
    int band_begin = 0;
    int band_end = 0;
};

// Makes the band hold `row`.
void PictureRows::Impl::load(int row) {
    if (row >= band_begin && row < band_end) return;
    const OIIO::ImageSpec& spec = source.spec();
    const int rows = source.rows_at_once(kRowsAtOnce);
    const int begin = row / rows * rows;
    const int end = std::min(begin + rows, spec.height);
    band_begin = band_end = 0;
    if (band.height() != end - begin) band = Image(spec.width, end - begin, band_channels);
    source.read(begin, end, first_channel, band, 0);
    if (!source.is_exr()) linearize(spec, channels, band);
    band_begin = begin;
    band_end = end;
}

PictureRows::PictureRows(const std::string& path) {
    impl_ = with_file_errors(path, [&] { return std::make_unique<Impl>(path); });
    const OIIO::ImageSpec& spec = impl_->source.spec();
    const bool exr = impl_->source.is_exr();
    if (!exr && spec.get_int_attribute("Orientation", 1) != 1) {
        impl_->turned = read_picture(path);
        data_window_ = impl_->turned->data_window();
        display_window_ = impl_->turned->display_window();
        return;
    }
    data_window_ = {0, 0, spec.width, spec.height};
    display_window_ = data_window_;
    if (exr) {
        data_window_ = {spec.x, spec.y, spec.width, spec.height};
        display_window_ = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
    }

    ColorChannels& channels = impl_->channels;
    channels = find_color_channels(spec.channelnames);
    if (exr) channels.alpha = -1;  // its colour does not depend on it
    std::vector<int> needed = channels.color;
    if (channels.alpha >= 0) needed.push_back(channels.alpha);
    const auto [least, most] = std::minmax_element(needed.begin(), needed.end());
    impl_->first_channel = *least;
    impl_->band_channels = *most - *least + 1;
    for (int& c : channels.color) c -= impl_->first_channel;
    if (channels.alpha >= 0) channels.alpha -= impl_->first_channel;
}

PictureRows::~PictureRows() = default;
PictureRows::PictureRows(PictureRows&&) noexcept = default;
PictureRows& PictureRows::operator=(PictureRows&&) noexcept = default;

void PictureRows::read(int first_row, int count, const ImageView& out) {
    if (first_row < 0 || count < 0 || count > height() - first_row) {
        throw InvalidArgument("rows", fmt::format("{} from {} on", count, first_row),
                              fmt::format("the picture has {}", height()));
    }
    if (out.width != width() || out.height != count || out.channels != 3) {
        throw InvalidArgument(
            "image for rows",
            fmt::format("{}x{}, {} channels", out.width, out.height, out.channels),
            fmt::format("must be {}x{}, 3 channels", width(), count));
    }
    for (int y = 0; y < count; ++y) {
        const int row = first_row + y;
        if (!impl_->turned) with_file_errors(impl_->source.path(), [&] { impl_->load(row); });
        for (int c = 0; c < 3; ++c) {
            const float* from = nullptr;
            if (impl_->turned) {
                from = impl_->turned->image().row(row,
                                                  std::min(c, impl_->turned->color_channels() - 1));
            } else {
                const auto& color = impl_->channels.color;
                const auto index = std::min(static_cast<std::size_t>(c), color.size() - 1);
                from = impl_->band.row(row - impl_->band_begin, color[index]);
            }
            for (int x = 0; x < out.width; ++x) out.at(x, y, c) = from[x];
        }
    }
}

}  // namespace aureole::io
