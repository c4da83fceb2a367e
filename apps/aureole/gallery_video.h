// Films of numbered frames, by the program ffmpeg where there is one.
#pragma once

#include <string>

namespace aureole::app {

enum class Video { kWritten, kNoFfmpeg, kFailed };

// Writes an MP4 (H.264, 4:2:0, padded to even sizes) of the frames `folder`/NAME.0000.png and so
// on. ffmpeg is started directly, without a shell; it reads and prints nothing. A film that failed
// leaves no file.
Video write_video(const std::string& folder, const std::string& name, double frames_per_second,
                  const std::string& file);

}  // namespace aureole::app
