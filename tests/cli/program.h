// Runs the program, and what its tests share.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "aureole/image/image.h"
#include "aureole/io/picture.h"

namespace aureole::cli {

// A new empty folder, removed with everything in it at the end.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string file(const std::string& name) const { return (path_ / name).string(); }
    const std::filesystem::path& path() const { return path_; }
    std::vector<std::string> names() const;  // sorted, hidden files too

  private:
    std::filesystem::path path_;
};

struct Outcome {
    int exit_code = -1;  // minus the signal that ended the program, if one did
    std::string out;
    std::string err;
};

struct Conditions {
    std::optional<std::size_t> largest_file;         // bytes; a disk that is full at some point
    std::map<std::string, std::string> environment;  // added to that of the test
    std::string standard_output;                     // file to write to instead of Outcome::out
};

// One run of the program in the background. `words`: its arguments, separated by blanks.
class Program {
  public:
    Program(const std::filesystem::path& folder, const std::string& words,
            const Conditions& conditions = {});
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    bool running();
    void signal(int number) const;
    std::string err() const;  // standard error up to now
    Outcome wait();

  private:
    TemporaryFolder streams_;
    pid_t process_ = -1;
    std::optional<int> status_;
};

// An eye that takes a quarter of the time: scatter without any diffraction.
inline const std::string kPlainEye = " --corona-contrast 0 --halo 0 --streaks 0 ";

// A test with a folder of its own, in which the program runs: names are relative to it.
class CliTest : public testing::Test {
  protected:
    Outcome run(const std::string& words, const Conditions& conditions = {}) const;
    // Runs with --json; the report. Expects exit code 0.
    nlohmann::json report(const std::string& words) const;

    std::string file(const std::string& name) const { return folder_.file(name); }
    bool exists(const std::string& name) const { return std::filesystem::exists(file(name)); }
    io::Picture read(const std::string& name) const { return io::read_picture(file(name)); }
    void write(const std::string& name, const io::Picture& picture) const;
    void write(const std::string& name, const Image& image,
               const std::vector<std::string>& channels = {}) const;
    std::string bytes(const std::string& name) const;
    void write_bytes(const std::string& name, const std::string& text) const;

    TemporaryFolder folder_;
};

// Values over six decades, a tenth of them negative.
Image noise(int width, int height, int channels, unsigned seed = 1);
Image constant(int width, int height, int channels, float value);
// Black, with one pixel of `value` in all channels.
Image point(int width, int height, int channels, int x, int y, float value);

// A kernel of sum 1 in every channel, size x size: (1 + r^2)^-1.5.
Image soft_kernel(int size);

// The channel of a picture by its name; fails the test if there is none.
Image channel(const io::Picture& picture, const std::string& name);
// Bit for bit.
bool identical(const Image& a, const Image& b);
double largest_difference(const ConstImageView& a, const ConstImageView& b);
double largest(const ConstImageView& image);

// Every word is in the text.
testing::AssertionResult names_all(const std::string& text, const std::vector<std::string>& words);

}  // namespace aureole::cli
