#include "aureole/io/binary_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "aureole/base/error.h"
#include "io/atomic_file.h"

namespace aureole::io {
namespace {

// A file that is open for reading.
class Descriptor {
  public:
    explicit Descriptor(const std::string& path)
        : number_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }

  private:
    int number_;
};

void unmap(std::span<const std::byte> bytes) {
    // The system takes any pointer that it gave.
    if (!bytes.empty()) ::munmap(const_cast<std::byte*>(bytes.data()), bytes.size());
}

}  // namespace

MappedFile::MappedFile(const std::string& path) {
    const auto failed = [&path](int reason) {
        return FileError(path, std::string("cannot be read: ") + std::strerror(reason));
    };
    const Descriptor file(path);
    struct stat status {};
    if (file.number() < 0 && errno == ENOENT) throw FileError(path, "there is no such file");
    if (file.number() < 0 || ::fstat(file.number(), &status) != 0) throw failed(errno);
    if (S_ISDIR(status.st_mode)) throw FileError(path, "cannot be read: it is a folder");
    if (!S_ISREG(status.st_mode)) throw FileError(path, "cannot be read: it is no plain file");
    if (status.st_size == 0) throw FileError(path, "is empty (0 bytes)");
    const auto size = static_cast<std::size_t>(status.st_size);
    void* const memory = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.number(), 0);
    if (memory == MAP_FAILED) throw failed(errno);
    bytes_ = {static_cast<const std::byte*>(memory), size};
}

MappedFile::~MappedFile() { unmap(bytes_); }

MappedFile::MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept {
    std::swap(bytes_, other.bytes_);
    return *this;
}

void write_binary_file(const std::string& path, std::span<const std::byte> bytes) {
    AtomicFile file(path);
    file.write(bytes.data(), bytes.size());
    file.commit();
}

}  // namespace aureole::io
