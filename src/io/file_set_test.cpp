#include "aureole/io/file_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/io/text_file.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

std::vector<std::string> names_in(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
        names.push_back(entry.path().filename().string());
    }
    return names;
}

TEST(FileSet, ANewFolderAppearsWhole) {
    const TemporaryFolder folder;
    for (const char* name : {"out", "out2/"}) {
        const std::string target = folder.file(name);
        FileSet set(target);
        write_text_file(set.path("a.txt"), "A");
        write_text_file(set.path("replaced"), "B");
        EXPECT_FALSE(fs::exists(target));
        set.commit();
        EXPECT_THAT(names_in(target), UnorderedElementsAre("a.txt", "replaced"));
        EXPECT_EQ(read_bytes(folder.file(name) + "/a.txt"), "A");
        EXPECT_EQ(fs::status(target).permissions() & fs::perms::owner_all, fs::perms::owner_all);
        EXPECT_THROW(set.commit(), InvalidArgument);
        EXPECT_THROW(set.path("c.txt"), InvalidArgument);
    }
    EXPECT_THAT(folder.names(), UnorderedElementsAre("out", "out2"));
}

TEST(FileSet, OnlyFilesOfTheSameNamesAreReplaced) {
    const TemporaryFolder folder;
    const std::string target = folder.file("out");
    fs::create_directories(target + "/sub");
    write_bytes(target + "/a.txt", "old a");
    write_bytes(target + "/other.txt", "other");
    {
        FileSet set(target);
        write_text_file(set.path("a.txt"), "new a");
        write_text_file(set.path("b.txt"), "new b");
        EXPECT_EQ(read_bytes(target + "/a.txt"), "old a");
        EXPECT_FALSE(fs::exists(target + "/b.txt"));
        set.commit();
    }
    EXPECT_THAT(names_in(target), UnorderedElementsAre("a.txt", "b.txt", "other.txt", "sub"));
    EXPECT_EQ(read_bytes(target + "/a.txt"), "new a");
    EXPECT_EQ(read_bytes(target + "/b.txt"), "new b");
    EXPECT_EQ(read_bytes(target + "/other.txt"), "other");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
}

TEST(FileSet, WithoutCommitNothingIsLeft) {
    const TemporaryFolder folder;
    {
        const FileSet set(folder.file("new"));
        write_text_file(set.path("a.txt"), "A");
    }
    EXPECT_TRUE(folder.names().empty());
    write_bytes(folder.file("a.txt"), "old");
    {
        const FileSet set(folder.file(""));
        write_text_file(set.path("a.txt"), "A");
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
    EXPECT_EQ(read_bytes(folder.file("a.txt")), "old");
}

// A folder stands where the last file is to go: those before it are put back.
TEST(FileSet, AFailedCommitLeavesTheTargetAsItWas) {
    const TemporaryFolder folder;
    write_bytes(folder.file("a.txt"), "old a");
    fs::create_symlink("a.txt", folder.file("c.txt"));
    fs::create_directory(folder.file("d.txt"));
    {
        FileSet set(folder.file(""));
        for (const char* name : {"a.txt", "b.txt", "c.txt", "d.txt"}) {
            write_text_file(set.path(name), "new");
        }
        try {
            set.commit();
            ADD_FAILURE() << "a folder was replaced by a file";
        } catch (const FileError& error) {
            EXPECT_EQ(error.file(), folder.file(""));
            EXPECT_THAT(error.what(), HasSubstr("d.txt cannot be written"));
        }
    }
    EXPECT_THAT(folder.names(), UnorderedElementsAre("a.txt", "c.txt", "d.txt"));
    EXPECT_EQ(read_bytes(folder.file("a.txt")), "old a");
    EXPECT_EQ(fs::read_symlink(folder.file("c.txt")), "a.txt");
    EXPECT_TRUE(fs::is_directory(folder.file("d.txt")));
    EXPECT_EQ(fs::hard_link_count(folder.file("a.txt")), 1U);
}

// What appears meanwhile at the place of a new folder is not harmed.
TEST(FileSet, AFolderThatAppearedMeanwhileIsKept) {
    const TemporaryFolder folder;
    std::optional<FileSet> set(folder.file("out"));
    write_text_file(set->path("a.txt"), "A");
    fs::create_directory(folder.file("out"));
    write_bytes(folder.file("out/theirs.txt"), "theirs");
    EXPECT_THROW(set->commit(), FileError);
    set.reset();
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
    EXPECT_EQ(names_in(folder.file("out")), std::vector<std::string>{"theirs.txt"});
}

TEST(FileSet, SymbolicLinksToFoldersAreFollowed) {
    const TemporaryFolder folder;
    fs::create_directory(folder.file("real"));
    fs::create_directory_symlink("real", folder.file("link"));
    FileSet set(folder.file("link"));
    write_text_file(set.path("a.txt"), "A");
    set.commit();
    EXPECT_TRUE(fs::is_symlink(folder.file("link")));
    EXPECT_EQ(names_in(folder.file("real")), std::vector<std::string>{"a.txt"});
}

TEST(FileSet, WhereNothingCanBeWrittenIsKnownAtOnce) {
    const TemporaryFolder folder;
    const auto refusal = [](const std::string& target) -> std::string {
        try {
            const FileSet set(target);
        } catch (const FileError& error) {
            EXPECT_EQ(error.file(), target);
            return error.what();
        }
        return "";
    };
    write_bytes(folder.file("file"), "x");
    EXPECT_THAT(refusal(folder.file("file")), HasSubstr("it is a file"));
    EXPECT_THAT(refusal(folder.file("none/out")), HasSubstr("there is no folder"));
    EXPECT_THAT(refusal("/proc/aureole"), HasSubstr("cannot be written in folder /proc"));
    EXPECT_THAT(refusal("/proc"), HasSubstr("cannot be written in folder /proc"));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

TEST(FileSet, NamesAreWithoutFolders) {
    const TemporaryFolder folder;
    const FileSet set(folder.file("out"));
    for (const std::string& name : {std::string(), std::string("."), std::string(".."),
                                    std::string("a/b"), std::string("/a"), std::string(1, '\0')}) {
        EXPECT_THROW(set.path(name), InvalidArgument) << name;
    }
    EXPECT_NO_THROW(set.path("..a"));
}

}  // namespace
}  // namespace aureole::io
