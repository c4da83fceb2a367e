#include "gallery_video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <vector>

namespace aureole::app {
namespace {

// What stands for itself in a pattern of ffmpeg.
std::string without_patterns(const std::string& path) {
    std::string escaped;
    for (const char c : path) escaped += c == '%' ? "%%" : std::string(1, c);
    return escaped;
}

// Runs a program, named by the first word, to its end. 0, or the errno that kept it from running.
int run_silently(std::vector<std::string> words, int& status) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t process = 0;
    const int error =
        posix_spawnp(&process, arguments.front(), &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) return error;
    while (waitpid(process, &status, 0) < 0) {
        if (errno != EINTR) return errno;
    }
    return 0;
}

}  // namespace

Video write_video(const std::string& folder, const std::string& name, double frames_per_second,
                  const std::string& file) {
    const std::string frames = without_patterns(folder + "/" + name) + ".%04d.png";
    int status = 0;
    const int error = run_silently({"ffmpeg",
                                    "-nostdin",
                                    "-loglevel",
                                    "error",
                                    "-y",
                                    "-framerate",
                                    fmt::format("{}", frames_per_second),
                                    "-start_number",
                                    "0",
                                    "-i",
                                    frames,
                                    "-vf",
                                    "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                    "-c:v",
                                    "libx264",
                                    "-crf",
                                    "14",
                                    "-pix_fmt",
                                    "yuv420p",
                                    "-movflags",
                                    "+faststart",
                                    "-f",
                                    "mp4",
                                    file},
                                   status);
    if (error == ENOENT) return Video::kNoFfmpeg;
    if (error == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0) return Video::kWritten;
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    return Video::kFailed;
}

}  // namespace aureole::app
