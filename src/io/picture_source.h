// The samples of a picture file, rows at a time: internal to the module.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "aureole/image/image.h"

namespace aureole::io {

class PictureSource {
  public:
    // Opens the file and chooses the part that has the colour. Throws FileError.
    explicit PictureSource(const std::string& path);

    const std::string& path() const noexcept { return path_; }
    bool is_exr() const noexcept { return exr_; }
    // Of the part that is read.
    const OIIO::ImageSpec& spec() const noexcept { return spec_; }
    std::size_t part() const noexcept { return part_; }
    std::size_t parts() const noexcept { return parts_; }
    // How a channel's samples come: EXR in its own type, because OpenImageIO scales integers to
    // [0, 1] and the uint channels of EXR are ids; other formats as the float it makes of them.
    OIIO::TypeDesc type(int channel) const { return types_[static_cast<std::size_t>(channel)]; }

    // The fewest rows that read() takes from the file without decoding any twice; `most` if the
    // file does not care. A picture's last rows may be fewer.
    int rows_at_once(int most) const;

    // Samples of rows [begin, end), counted from the top, of image.channels() channels from
    // `first_channel` on, into the rows of `image` from `top` on. begin is a multiple of
    // rows_at_once(), and so is end unless it is the height. Where ids[c] is not empty, it gets the
    // values of the uint channel c besides, one per pixel of `image`.
    // Rows may be asked for in any order; going back in a file other than EXR decodes it anew.
    // Throws FileError for truncated or damaged files.
    void read(int begin, int end, int first_channel, Image& image, int top,
              std::vector<std::vector<std::uint32_t>>* ids = nullptr);

  private:
    std::string path_;
    std::unique_ptr<OIIO::ImageInput> input_;
    OIIO::ImageSpec spec_;
    std::vector<OIIO::TypeDesc> types_;
    bool exr_ = false;
    std::size_t part_ = 0;
    std::size_t parts_ = 1;
    std::vector<std::byte> buffer_;
};

}  // namespace aureole::io
