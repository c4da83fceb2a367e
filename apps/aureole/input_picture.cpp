#include "input_picture.h"

#include <fmt/core.h>

#include "aureole/image/finite.h"

namespace aureole::app {

InputPicture read_input(const std::string& file, Session& session) {
    InputPicture input{session.timed("read", [&] { return io::read_picture(file); })};
    input.nonfinite_pixels = replace_nonfinite(input.picture.color());
    if (input.nonfinite_pixels > 0) {
        session.note(fmt::format("{}: {} pixels with NaN or infinity replaced by 0", file,
                                 input.nonfinite_pixels));
    }
    return input;
}

}  // namespace aureole::app
