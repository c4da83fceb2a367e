// Which files a command reads and writes: single pictures, several pictures into a folder, and
// numbered sequences.
#pragma once

#include <string>
#include <vector>

namespace aureole::app {

struct FrameFiles {
    int number = 0;     // of the frame; without a sequence, the place in the list
    double time_s = 0;  // at which it is seen
    std::string input;
    std::vector<std::string> outputs;
    std::string side_by_side;  // empty: none
};

// One entry per picture, all seen at 0 s, in order. `frames` ("1001-1240", or empty) makes numbers
// out of %04d and
// #### in the names; without it, names are taken as they are. An output that is a folder gets
// files that are named like the inputs.
// Everything that can be wrong about names is found here: throws InvalidArgument, FileError.
std::vector<FrameFiles> frame_files(const std::vector<std::string>& inputs,
                                    const std::vector<std::string>& outputs,
                                    const std::string& side_by_side, const std::string& frames);

}  // namespace aureole::app
