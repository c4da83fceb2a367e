// A file that appears whole or not at all.
#pragma once

#include <OpenImageIO/filesystem.h>

#include <cstdio>
#include <string>

namespace aureole::io {

// Written by OpenImageIO's encoders through its proxy interface, because several of them do not
// look at what fwrite and fclose return: here the first failure is kept and thrown by commit().
class AtomicFile : public OIIO::Filesystem::IOProxy {
  public:
    // Creates the temporary file beside `path`. A symbolic link is followed, not replaced.
    // Throws FileError.
    explicit AtomicFile(const std::string& path);
    // Removes the temporary file unless commit() succeeded.
    ~AtomicFile() override;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    // Why writing failed, or empty.
    std::string failure() const;
    // Flushes, closes and renames; throws FileError if that or any write before it failed.
    void commit();

    const char* proxytype() const override { return "aureole"; }
    bool seek(int64_t offset) override;
    std::size_t read(void* data, std::size_t size) override;
    std::size_t write(const void* data, std::size_t size) override;
    std::size_t pread(void* data, std::size_t size, int64_t offset) override;
    std::size_t pwrite(const void* data, std::size_t size, int64_t offset) override;
    std::size_t size() const override;
    void flush() const override;

  private:
    void position(int64_t offset, int direction);

    std::string path_;       // as the caller named it, for messages
    std::string target_;     // where the file ends up
    std::string temporary_;  // where it is until then; empty after commit()
    std::FILE* file_ = nullptr;
    int64_t size_ = 0;
    int64_t stream_position_ = 0;  // of file_
    int direction_ = 0;            // last operation on file_: 'r', 'w'
    int error_ = 0;                // first errno
};

}  // namespace aureole::io
