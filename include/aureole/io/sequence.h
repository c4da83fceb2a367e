// Numbered picture sequences: which frames, and what their files are called.
// To be used where frames were asked for: a single picture may be called "50% #2.exr".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace aureole::io {

// Frame numbers from text: "5", "1001-1240", "1-10x2" (every second: 1 3 5 7 9), and lists of
// these with commas: "1-3,7,20-30x5". Numbers may be negative ("-5--1"). Order as given; a frame
// that comes again is dropped.
// Throws InvalidArgument for anything else, a last frame before the first, a step below 1, or more
// than a million frames.
std::vector<int> parse_frames(std::string_view text);

// Whether a file name has a place for the frame number: "%d", "%04d" (padded with zeros to four
// digits), or a run of "#", one per digit ("shot.####.exr"). "%%" stands for one "%" in names that
// have a printf field. Only the file name is looked at, not the folders.
// Throws InvalidArgument for a name with more than one place, or an unknown "%" field.
bool has_frame_number(std::string_view pattern);

// The path of one frame. A pattern without a number is returned as it is.
// Throws as has_frame_number().
std::string frame_path(std::string_view pattern, int frame);

// The paths of several frames.
// Throws as has_frame_number(), and InvalidArgument if there are several frames but the pattern
// has no number: they would all be one file.
std::vector<std::string> frame_paths(std::string_view pattern, const std::vector<int>& frames);

}  // namespace aureole::io
