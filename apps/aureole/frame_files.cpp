#include "frame_files.h"

#include <filesystem>

#include "aureole/base/error.h"
#include "aureole/io/sequence.h"
#include "output_options.h"

namespace aureole::app {
namespace {

namespace fs = std::filesystem;

bool is_folder(const std::string& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

std::string inside(const std::string& folder, const std::string& input) {
    const std::string path = (fs::path(folder) / fs::path(input).filename()).string();
    std::error_code ignored;
    if (fs::equivalent(path, input, ignored)) {
        throw InvalidArgument("--output", folder,
                              "is the folder of " + input + ", which would be overwritten");
    }
    return path;
}

// A name like shot.%04d.exr that is no file: someone forgot --frames.
void check_plain_name(const std::string& input) {
    if (fs::exists(input)) return;
    bool numbered = false;
    try {
        numbered = io::has_frame_number(input);
    } catch (const InvalidArgument&) {
        return;  // any other use of % or #: reading it will say that there is no such file
    }
    if (numbered) {
        throw InvalidArgument("INPUT", input,
                              "is the name of a sequence: say which with --frames, as in "
                              "--frames 1-10");
    }
}

std::vector<std::string> names_of(const std::string& output, const std::vector<std::string>& inputs,
                                  const std::vector<int>& frames) {
    std::vector<std::string> names;
    if (is_folder(output)) {
        for (const std::string& input : inputs) names.push_back(inside(output, input));
        return names;
    }
    if (!frames.empty()) return io::frame_paths(output, frames);
    if (inputs.size() > 1) {
        throw InvalidArgument("--output", output, "must be an existing folder for several inputs");
    }
    return {output};
}

}  // namespace

std::vector<FrameFiles> frame_files(const std::vector<std::string>& inputs,
                                    const std::vector<std::string>& outputs,
                                    const std::string& side_by_side, const std::string& frames) {
    std::vector<int> numbers;
    std::vector<std::string> in = inputs;
    if (!frames.empty()) {
        if (inputs.size() != 1) {
            throw InvalidArgument("--frames", frames, "needs exactly one numbered INPUT");
        }
        numbers = io::parse_frames(frames);
        in = io::frame_paths(inputs[0], numbers);
    } else {
        for (const std::string& input : inputs) check_plain_name(input);
    }

    std::vector<FrameFiles> list(in.size());
    std::vector<std::string> all;
    for (std::size_t i = 0; i < in.size(); ++i) {
        list[i].number = numbers.empty() ? static_cast<int>(i) : numbers[i];
        list[i].input = in[i];
    }
    for (const std::string& output : outputs) {
        const std::vector<std::string> names = names_of(output, in, numbers);
        for (std::size_t i = 0; i < in.size(); ++i) list[i].outputs.push_back(names[i]);
        all.insert(all.end(), names.begin(), names.end());
    }
    if (!side_by_side.empty()) {
        if (!is_display_file(side_by_side)) {
            throw InvalidArgument("--side-by-side", side_by_side, "must be PNG or JPEG");
        }
        if (in.size() > 1 && numbers.empty()) {
            throw InvalidArgument("--side-by-side", side_by_side,
                                  "is one file, for one picture or a numbered sequence");
        }
        const std::vector<std::string> names = names_of(side_by_side, in, numbers);
        for (std::size_t i = 0; i < in.size(); ++i) list[i].side_by_side = names[i];
        all.insert(all.end(), names.begin(), names.end());
    }
    check_outputs(all);
    return list;
}

}  // namespace aureole::app
