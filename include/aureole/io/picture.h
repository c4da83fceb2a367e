// Pictures in files. A Picture is what was in the file: all channels in linear float, its windows,
// its metadata, and whatever else the file held, so that writing it again loses nothing.
//
//   io::Picture picture = io::read_picture("render.exr");
//   ... change picture.color() ...
//   io::write_picture("glare.exr", picture);
//
// Formats, conversions and limits: docs/pictures.md.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::io {

// A rectangle of pixels; (x, y) is its top left one. All windows of a picture share one coordinate
// system, x to the right and y downwards.
struct Window {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool operator==(const Window&) const = default;
};

// Which of a picture's channels are its colour.
struct ColorChannels {
    std::vector<int> color;  // R, G, B; or one grey channel
    int alpha = -1;          // -1: none
};

// Finds the colour among channel names, in any order and upper or lower case. A name may carry a
// layer, "beauty.R"; names without one come first, then the layers in order of appearance. The
// first with all of R, G, B (or red, green, blue) wins; else the first with a grey channel (Y, L,
// luminance, gray, grey); else the first channel that is neither alpha nor depth is taken as grey.
// Alpha (A, alpha) must be in the layer of the colour. `names` must not be empty.
ColorChannels find_color_channels(const std::vector<std::string>& names);

struct PictureMetadata;  // defined inside the module

class Picture {
  public:
    // A new picture without metadata; data and display window are (0, 0, width, height). Without
    // names the channels are Y; Y, A; R, G, B; R, G, B, A; any more are channel4, channel5...
    // Channels are put in the order colour, alpha, others (see color()).
    // Throws InvalidArgument for an empty image, or names that are empty, repeated or not as many
    // as there are channels.
    explicit Picture(Image image, std::vector<std::string> channel_names = {});

    // All channels over the data window. The first color_channels() are the colour (R, G, B or one
    // grey), then alpha if there is one, then the others.
    const Image& image() const noexcept { return image_; }
    Image& image() noexcept { return image_; }
    const std::vector<std::string>& channel_names() const noexcept { return channel_names_; }
    int color_channels() const noexcept { return color_channels_; }  // 3 or 1
    int alpha_channel() const noexcept { return alpha_channel_; }    // -1: none
    ImageView color() noexcept;             // the colour channels of image()
    ConstImageView color() const noexcept;  // the same, read-only

    // Adds channels that are named like this picture's colour channels in another layer: "glare"
    // gives glare.R, glare.G, glare.B. `channels` must have the size of image() and
    // color_channels() channels.
    // Throws InvalidArgument for another size, an empty layer or a name that is taken.
    void append_layer(const std::string& layer, const ConstImageView& channels);
    // Adds any channels; as many names as channels.
    void append_channels(const std::vector<std::string>& names, const ConstImageView& channels);

    // Where the pixels of image() lie, and what part of them is meant to be seen. The data window
    // may be larger than the display window (overscan), smaller, or somewhere else.
    Window data_window() const noexcept;
    const Window& display_window() const noexcept { return display_window_; }
    void set_data_origin(int x, int y) noexcept;
    // Throws InvalidArgument unless width and height are positive.
    void set_display_window(const Window& window);

    // Width of a pixel over its height.
    double pixel_aspect_ratio() const noexcept { return pixel_aspect_ratio_; }
    void set_pixel_aspect_ratio(double ratio);

    // Metadata by name ("aureole:fov_deg", "screenWindowWidth", "Exif:FNumber"; names as
    // OpenImageIO gives them). A number of any type is converted to float; nullopt if there is no
    // such attribute or it is of the other kind.
    std::optional<float> float_attribute(const std::string& name) const;
    std::optional<std::string> string_attribute(const std::string& name) const;
    std::vector<std::string> attribute_names() const;
    void set_attribute(const std::string& name, float value);
    void set_attribute(const std::string& name, const std::string& value);
    void erase_attribute(const std::string& name);

    // How many other parts of a multi-part EXR travel with this one, as the bytes they were.
    int other_parts() const noexcept;

  private:
    friend struct PictureAccess;

    PictureMetadata& own_metadata();

    Image image_;
    std::vector<std::string> channel_names_;
    int color_channels_ = 0;
    int alpha_channel_ = -1;
    int data_x_ = 0;
    int data_y_ = 0;
    Window display_window_;
    double pixel_aspect_ratio_ = 1;
    std::shared_ptr<const PictureMetadata>
        metadata_;  // shared by copies until one of them changes it
};

// Reads EXR (scan lines or tiles; half, float, uint; multi-part), HDR, TIFF, PNG and JPEG.
// Of a multi-part EXR the first part that has colour is read, the others travel along.
// Colour of 8- and 16-bit files is decoded from sRGB to linear unless the file says otherwise, and
// multiplied by its alpha where the format stores it unmultiplied; float files are taken as linear
// and not changed. NaN and infinities are kept: see image/finite.h.
// Throws FileError if the file is missing, unreadable, empty, not a picture, truncated, damaged or
// deep.
Picture read_picture(const std::string& path);

enum class Depth { kFloat, kHalf };

struct WriteOptions {
    // EXR only: of the colour channels and of those that were appended. Half precision has 11 bits
    // and ends at 65504; it loses the wings of a kernel. Other channels keep the type they had.
    Depth depth = Depth::kFloat;
};

struct WriteReport {
    // Finite samples that the format could not hold and that were clipped: beyond +-65504 in a half
    // channel, negative in an HDR file. Not counted: [0, 1] in PNG and JPEG, where it is meant.
    std::size_t clipped_samples = 0;
};

// Writes by extension: .exr (zip), .hdr, .tif/.tiff (32-bit float, zip), .png (8 bit), .jpg/.jpeg.
// For PNG and JPEG the caller passes display-encoded values in [0, 1]; they are rounded, not
// dithered. EXR keeps everything; TIFF all channels over the display window; PNG colour and alpha,
// JPEG and HDR colour, over the display window.
// The file appears whole or not at all: it is written beside `path` under a temporary name and
// renamed at the end; on any failure the temporary file is removed and what was at `path` stays.
// Throws InvalidArgument for an unknown extension, FileError if the folder is missing or not
// writable, the disk is full, or anything else fails.
WriteReport write_picture(const std::string& path, const Picture& picture,
                          const WriteOptions& options = {});

// Whether write_picture() knows the extension.
bool has_picture_extension(const std::string& path);
// Throws InvalidArgument unless it does: to fail before hours of work instead of after.
void check_picture_extension(const std::string& path);

}  // namespace aureole::io
