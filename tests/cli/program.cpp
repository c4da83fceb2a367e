#include "program.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>

namespace aureole::cli {
namespace {

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::string> split(const std::string& words) {
    std::istringstream stream(words);
    return {std::istream_iterator<std::string>(stream), std::istream_iterator<std::string>()};
}

void redirect(int stream, const std::string& path) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    if (descriptor < 0 || ::dup2(descriptor, stream) < 0) ::_exit(126);
    ::close(descriptor);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "aureole-cli-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp: " + name);
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
    std::vector<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
        result.push_back(entry.path().filename().string());
    }
    std::sort(result.begin(), result.end());
    return result;
}

Program::Program(const std::filesystem::path& folder, const std::string& words,
                 const Conditions& conditions) {
    std::vector<std::string> arguments = {AUREOLE_PROGRAM};
    for (std::string& word : split(words)) arguments.push_back(std::move(word));
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);

    const std::string out =
        conditions.standard_output.empty() ? streams_.file("out") : conditions.standard_output;
    const std::string err = streams_.file("err");
    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("fork failed");
    if (process_ > 0) return;

    redirect(STDOUT_FILENO, out);
    redirect(STDERR_FILENO, err);
    for (const auto& [name, value] : conditions.environment) {
        ::setenv(name.c_str(), value.c_str(), 1);
    }
    if (conditions.largest_file) {
        const rlimit limit = {*conditions.largest_file, *conditions.largest_file};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (::chdir(folder.c_str()) != 0) ::_exit(126);
    ::execv(AUREOLE_PROGRAM, argv.data());
    ::_exit(127);
}

Program::~Program() {
    if (!running()) return;
    signal(SIGKILL);
    wait();
}

bool Program::running() {
    if (status_) return false;
    int status = 0;
    if (::waitpid(process_, &status, WNOHANG) == 0) return true;
    status_ = status;
    return false;
}

void Program::signal(int number) const { ::kill(process_, number); }

std::string Program::err() const { return read_text(streams_.file("err")); }

Outcome Program::wait() {
    if (!status_) {
        int status = 0;
        ::waitpid(process_, &status, 0);
        status_ = status;
    }
    const int code = WIFEXITED(*status_) ? WEXITSTATUS(*status_) : -WTERMSIG(*status_);
    return {code, read_text(streams_.file("out")), err()};
}

Outcome CliTest::run(const std::string& words, const Conditions& conditions) const {
    return Program(folder_.path(), words, conditions).wait();
}

nlohmann::json CliTest::report(const std::string& words) const {
    const Outcome outcome = run(words + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << words << "\n" << outcome.err;
    return nlohmann::json::parse(outcome.out, nullptr, false);
}

void CliTest::write(const std::string& name, const io::Picture& picture) const {
    io::write_picture(file(name), picture);
}

void CliTest::write(const std::string& name, const Image& image,
                    const std::vector<std::string>& channels) const {
    write(name, io::Picture(image, channels));
}

std::string CliTest::bytes(const std::string& name) const { return read_text(file(name)); }

void CliTest::write_bytes(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
}

Image noise(int width, int height, int channels, unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    Image image(width, height, channels);
    for (int c = 0; c < channels; ++c) {
        for (std::size_t i = 0; i < image.pixels(); ++i) {
            const double sign = uniform() < 0.1 ? -1 : 1;
            image.plane(c)[i] = static_cast<float>(sign * std::pow(10, 6 * uniform() - 3));
        }
    }
    return image;
}

Image constant(int width, int height, int channels, float value) {
    Image image(width, height, channels);
    for (int c = 0; c < channels; ++c) {
        std::fill_n(image.plane(c), image.pixels(), value);
    }
    return image;
}

Image point(int width, int height, int channels, int x, int y, float value) {
    Image image(width, height, channels);
    for (int c = 0; c < channels; ++c) image.at(x, y, c) = value;
    return image;
}

Image soft_kernel(int size) {
    Image kernel(size, size, 3);
    const int centre = size / 2;
    double sum = 0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const double r = std::hypot(x - centre, y - centre);
            sum += std::pow(1 + r * r, -1.5);
        }
    }
    for (int c = 0; c < 3; ++c) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const double r = std::hypot(x - centre, y - centre);
                kernel.at(x, y, c) = static_cast<float>(std::pow(1 + r * r, -1.5) / sum);
            }
        }
    }
    return kernel;
}

Image channel(const io::Picture& picture, const std::string& name) {
    const auto& names = picture.channel_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        ADD_FAILURE() << "no channel " << name;
        return constant(1, 1, 1, 0);
    }
    const int index = static_cast<int>(found - names.begin());
    return copy(picture.image().view().channel_range(index, 1));
}

bool identical(const Image& a, const Image& b) {
    if (a.width() != b.width() || a.height() != b.height() || a.channels() != b.channels()) {
        return false;
    }
    for (int c = 0; c < a.channels(); ++c) {
        if (std::memcmp(a.plane(c), b.plane(c), a.pixels() * sizeof(float)) != 0) return false;
    }
    return true;
}

double largest_difference(const ConstImageView& a, const ConstImageView& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.channels, b.channels);
    double worst = 0;
    for (int c = 0; c < std::min(a.channels, b.channels); ++c) {
        for (int y = 0; y < std::min(a.height, b.height); ++y) {
            for (int x = 0; x < std::min(a.width, b.width); ++x) {
                worst = std::max(worst, std::abs(double{a.at(x, y, c)} - double{b.at(x, y, c)}));
            }
        }
    }
    return worst;
}

double largest(const ConstImageView& image) {
    return largest_difference(image, constant(image.width, image.height, image.channels, 0));
}

testing::AssertionResult names_all(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words) {
        if (text.find(word) == std::string::npos) {
            return testing::AssertionFailure() << "no \"" << word << "\" in:\n" << text;
        }
    }
    return testing::AssertionSuccess();
}

}  // namespace aureole::cli
