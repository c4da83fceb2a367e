// Several files that appear together or not at all.
//
//   io::FileSet set("environment");
//   io::write_texture(set.path("environment.ktx2"), texture);
//   io::write_text_file(set.path("report.json"), report);
//   set.commit();
#pragma once

#include <string>

namespace aureole::io {

// Files are written into a hidden folder and moved when all are there: beside the target,
// ".NAME.PID-N.tmp", if the target does not exist, and inside it if it does, so that they are on
// the same file system and need no other permission than the target itself gives.
//
// What is promised. If the target did not exist, it appears whole by one rename. If it did, each
// file replaces one of its name by a rename, so that no reader ever sees half a file or none, but
// between the first and the last rename it may see new files beside old ones; if one rename fails,
// those before it are undone. Files of other names, and folders, are left alone. A symbolic link
// among the replaced is replaced itself. Where the file system has no hard links (FAT), a name that
// is replaced is absent for the moment between two renames. Killed or struck by a power cut, a run
// may leave the hidden folder, and of a commit that was going on some files old, some new.
class FileSet {
  public:
    // Throws FileError unless files can be written into `folder`, or `folder` can be made: its
    // parent must exist. Nothing visible is made yet.
    explicit FileSet(const std::string& folder);
    // Removes everything that was written, unless commit() succeeded.
    ~FileSet();
    FileSet(const FileSet&) = delete;
    FileSet& operator=(const FileSet&) = delete;

    // Where to write the file that will be `folder`/`name`; until commit() only.
    // Throws InvalidArgument unless `name` is the name of a file without folders.
    std::string path(const std::string& name) const;

    // Moves all files that were written to the target; once. Throws FileError if that fails, and
    // leaves the target as it was; the set is then of no more use.
    void commit();

  private:
    void replace_files();

    std::string folder_;   // as the caller named it, for messages
    std::string target_;   // symbolic links followed
    std::string staging_;  // the hidden folder; empty after commit()
    bool exists_ = false;  // whether the target did at construction
};

}  // namespace aureole::io
