// Pictures too large to be held in memory at once, rows at a time.
//
//   io::PictureRows rows("sky_16k.exr");
//   Image band(rows.width(), 64, 3);
//   for (int y = 0; y < rows.height(); y += 64) rows.read(y, std::min(64, rows.height() - y), ...);
#pragma once

#include <memory>
#include <string>

#include "aureole/image/image.h"
#include "aureole/io/picture.h"

namespace aureole::io {

// The colour of any file that read_picture() reads, the same bits as its Picture::color(), but
// three channels always: grey is spread over them.
//
// Memory: the samples of 32 rows of the file, or of one row of its tiles where that is more, as the
// file has them and as float, in the colour channels and those between them: 20 to 30 MB for
// 16384 pixels of RGB in half precision, 80 with tiles of 256. Decoders add a few of their blocks:
// much with DWAB compression, whose blocks have 256 rows (270 MB for that width); the whole picture
// for interlaced PNG and, as coefficients, for progressive JPEG. A picture that its Exif
// orientation turns is held whole.
//
// Not for several threads at once.
class PictureRows {
  public:
    // Throws FileError as read_picture() does, except for damage further on in the file.
    explicit PictureRows(const std::string& path);
    ~PictureRows();
    PictureRows(PictureRows&&) noexcept;
    PictureRows& operator=(PictureRows&&) noexcept;

    // Of the data window, which is where the pixels are.
    int width() const noexcept { return data_window_.width; }
    int height() const noexcept { return data_window_.height; }
    const Window& data_window() const noexcept { return data_window_; }
    const Window& display_window() const noexcept { return display_window_; }

    // Rows [first_row, first_row + count) from the top of the data window into `out`, which has the
    // picture's width, `count` rows and 3 channels. Reading downwards decodes the file once; going
    // back costs decoding it again from its start, except for EXR. NaN and infinities are kept.
    // Throws InvalidArgument for rows outside the picture or another size of `out`, FileError if
    // the file is truncated or damaged there; what `out` then holds is not defined.
    void read(int first_row, int count, const ImageView& out);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
    Window data_window_;
    Window display_window_;
};

}  // namespace aureole::io
