#include "io/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "aureole/base/error.h"

namespace aureole::io {
namespace fs = std::filesystem;
namespace {

// An interrupted run leaves at most a hidden file of this name: ".NAME.PID-N.tmp.EXT".
std::string temporary_name(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    const std::string name = fmt::format(".{}.{}-{}.tmp{}", target.stem().string().substr(0, 100),
                                         ::getpid(), counter++, target.extension().string());
    return (target.parent_path() / name).string();
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
    std::error_code ignored;
    fs::path target = path;
    if (fs::is_symlink(target, ignored)) target = fs::weakly_canonical(target, ignored);
    if (fs::is_directory(target, ignored)) {
        throw FileError(path, "cannot be written: it is a folder");
    }
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored)) {
        throw FileError(path, "cannot be written: there is no folder " + folder.string());
    }
    target_ = target.string();
    temporary_ = temporary_name(target);
    const int descriptor = ::open(temporary_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor >= 0) file_ = ::fdopen(descriptor, "w+b");
    if (file_ == nullptr) {
        const int reason = errno;
        if (descriptor >= 0) {
            ::close(descriptor);
            ::unlink(temporary_.c_str());
        }
        throw FileError(
            path, "cannot be written in folder " + folder.string() + ": " + std::strerror(reason));
    }
    m_filename = temporary_;
    m_mode = Write;
}

AtomicFile::~AtomicFile() {
    if (file_ != nullptr) std::fclose(file_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

std::string AtomicFile::failure() const { return error_ == 0 ? "" : std::strerror(error_); }

void AtomicFile::commit() {
    const auto note = [&](bool failed) {
        if (failed && error_ == 0) error_ = errno;
    };
    note(std::fflush(file_) != 0);
    note(std::fclose(file_) != 0);
    file_ = nullptr;
    m_mode = Closed;
    if (error_ == 0) note(std::rename(temporary_.c_str(), target_.c_str()) != 0);
    if (error_ != 0) throw FileError(path_, "cannot be written: " + failure());
    temporary_.clear();
}

bool AtomicFile::seek(int64_t offset) {
    m_pos = offset;
    return true;
}

// Moves the stream only when it must: a seek empties stdio's buffer, and encoders write many small
// pieces in a row.
void AtomicFile::position(int64_t offset, int direction) {
    if (stream_position_ == offset && direction_ == direction) return;
    if (::fseeko(file_, offset, SEEK_SET) != 0 && error_ == 0) error_ = errno;
    stream_position_ = offset;
    direction_ = direction;
}

std::size_t AtomicFile::pwrite(const void* data, std::size_t size, int64_t offset) {
    position(offset, 'w');
    if (error_ != 0) return 0;
    const std::size_t written = std::fwrite(data, 1, size, file_);
    if (written != size) error_ = errno != 0 ? errno : EIO;
    stream_position_ += static_cast<int64_t>(written);
    size_ = std::max(size_, stream_position_);
    return written;
}

std::size_t AtomicFile::pread(void* data, std::size_t size, int64_t offset) {
    position(offset, 'r');
    const std::size_t got = std::fread(data, 1, size, file_);
    stream_position_ += static_cast<int64_t>(got);
    return got;
}

std::size_t AtomicFile::write(const void* data, std::size_t size) {
    const std::size_t written = pwrite(data, size, m_pos);
    m_pos += static_cast<int64_t>(written);
    return written;
}

std::size_t AtomicFile::read(void* data, std::size_t size) {
    const std::size_t got = pread(data, size, m_pos);
    m_pos += static_cast<int64_t>(got);
    return got;
}

std::size_t AtomicFile::size() const { return static_cast<std::size_t>(size_); }

void AtomicFile::flush() const { std::fflush(file_); }

}  // namespace aureole::io
