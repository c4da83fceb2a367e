// Where results go: -o, --depth, and how the files are written.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "aureole/image/image.h"
#include "aureole/io/picture.h"
#include "session.h"

namespace aureole::app {

class OutputOptions {
  public:
    void add_options(CLI::App& command, const std::string& description);
    // For commands that have something else to do: -o may then be missing.
    void make_optional() { option_->required(false); }

    // As given on the command line.
    const std::vector<std::string>& paths() const { return paths_; }
    const std::string& depth() const { return depth_; }

    // Throws InvalidArgument if half precision was asked for and no EXR is written.
    void check_depth(const std::vector<std::string>& files) const;
    // Writes a linear picture; notes samples that its format cannot hold.
    void write(const std::string& path, const io::Picture& picture, Session& session) const;

  private:
    CLI::Option* option_ = nullptr;
    std::vector<std::string> paths_;
    std::string depth_ = "float";
};

// What can be found out before the work is done. Throws InvalidArgument for an unknown extension
// and for a file that would be written twice, FileError for a folder that is missing or closed.
void check_outputs(const std::vector<std::string>& files);
// Throws FileError unless files can be made in the folder that `path` is in.
void check_folder(const std::string& path);

// Whether a file holds display values (PNG, JPEG) and not linear ones, by its extension.
bool is_display_file(const std::string& path);
bool is_exr_file(const std::string& path);

// Display values over the same windows as `original`, without alpha or anything else of it: alpha
// belongs to linear light, and light that glare put beside an object is no part of it.
io::Picture display_picture(const Image& encoded, const io::Picture& original);

// The part of `image`, which lies over the data window of `picture`, that is meant to be seen;
// black where there is no data.
Image over_display_window(const ConstImageView& image, const io::Picture& picture);

// Left half: the picture before; right half: after; a thin line between. Equal sizes.
Image side_by_side(const ConstImageView& before, const ConstImageView& after);

}  // namespace aureole::app
