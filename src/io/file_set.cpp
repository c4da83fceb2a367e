#include "aureole/io/file_set.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "aureole/base/error.h"

namespace aureole::io {
namespace fs = std::filesystem;
namespace {

// One file on its way: first what stands at its place gets a second name, then the file takes it.
class Replacement {
  public:
    Replacement(const fs::path& file, const fs::path& target, const fs::path& backup)
        : file_(file), target_(target), backup_(backup) {}

    // 0 or errno.
    int apply() {
        if (::link(target_.c_str(), backup_.c_str()) == 0) {
            has_backup_ = true;
        } else if (errno != ENOENT) {  // no hard links here, or not of other people's files
            if (std::rename(target_.c_str(), backup_.c_str()) != 0) return errno;
            has_backup_ = true;
        }
        if (std::rename(file_.c_str(), target_.c_str()) != 0) {
            const int reason = errno;
            restore();
            return reason;
        }
        return 0;
    }

    void undo() {
        if (!has_backup_) ::unlink(target_.c_str());
        restore();
    }

  private:
    void restore() {
        if (!has_backup_) return;
        static_cast<void>(std::rename(backup_.c_str(), target_.c_str()));
        // Two names of one file are left as they are by rename.
        ::unlink(backup_.c_str());
        has_backup_ = false;
    }

    fs::path file_;
    fs::path target_;
    fs::path backup_;
    bool has_backup_ = false;
};

std::string hidden_name(const fs::path& target) {
    static std::atomic<unsigned> counter{0};
    return fmt::format(".{}.{}-{}.tmp", target.filename().string().substr(0, 100), ::getpid(),
                       counter++);
}

// In the hidden folder.
constexpr const char* kNew = "new";
constexpr const char* kReplaced = "replaced";

}  // namespace

FileSet::FileSet(const std::string& folder) : folder_(folder) {
    std::error_code ignored;
    fs::path target = fs::absolute(folder.empty() ? "." : folder, ignored).lexically_normal();
    if (!target.has_filename()) target = target.parent_path();  // "out/"
    if (fs::is_symlink(target, ignored)) target = fs::weakly_canonical(target, ignored);
    target_ = target.string();
    exists_ = fs::exists(target, ignored);
    if (exists_ && !fs::is_directory(target, ignored)) {
        throw FileError(folder, "cannot be a folder of files: it is a file");
    }
    const fs::path parent = exists_ ? target : target.parent_path();
    if (!exists_ && !fs::is_directory(parent, ignored)) {
        throw FileError(folder, "cannot be made: there is no folder " + parent.string());
    }
    const fs::path staging = parent / hidden_name(target);
    if (::mkdir(staging.c_str(), 0777) != 0 || ::mkdir((staging / kNew).c_str(), 0777) != 0) {
        const int reason = errno;
        ::rmdir(staging.c_str());
        throw FileError(folder, "cannot be written in folder " + parent.string() + ": " +
                                    std::strerror(reason));
    }
    staging_ = staging.string();
}

FileSet::~FileSet() {
    std::error_code ignored;
    if (!staging_.empty()) fs::remove_all(staging_, ignored);
}

std::string FileSet::path(const std::string& name) const {
    if (staging_.empty()) throw InvalidArgument("the files of " + folder_ + " are in their place");
    if (name.empty() || name == "." || name == ".." ||
        name.find_first_of(std::string_view("/\0", 2)) != std::string::npos) {
        throw InvalidArgument("file name", name, "must be a name without folders");
    }
    return (fs::path(staging_) / kNew / name).string();
}

void FileSet::replace_files() {
    const fs::path staging = staging_;
    fs::create_directory(staging / kReplaced);
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(staging / kNew)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());  // the same order on every file system
    std::vector<Replacement> done;
    for (const fs::path& file : files) {
        const fs::path place = fs::path(target_) / file.filename();
        std::error_code ignored;
        Replacement replacement(file, place, staging / kReplaced / file.filename());
        const bool is_folder = fs::is_directory(fs::symlink_status(place, ignored));
        const int reason = is_folder ? EISDIR : replacement.apply();
        if (reason != 0) {
            std::for_each(done.rbegin(), done.rend(), [](Replacement& before) { before.undo(); });
            throw FileError(folder_, fmt::format("{} cannot be written: {}",
                                                 file.filename().string(), std::strerror(reason)));
        }
        done.push_back(std::move(replacement));
    }
}

void FileSet::commit() {
    if (staging_.empty()) throw InvalidArgument("the files of " + folder_ + " are in their place");
    if (exists_) {
        try {
            replace_files();
        } catch (const fs::filesystem_error& error) {
            throw FileError(folder_, "cannot be written: " + error.code().message());
        }
    } else if (std::rename((fs::path(staging_) / kNew).c_str(), target_.c_str()) != 0) {
        throw FileError(folder_, std::string("cannot be made: ") + std::strerror(errno));
    }
    std::error_code ignored;
    fs::remove_all(staging_, ignored);
    staging_.clear();
}

}  // namespace aureole::io
