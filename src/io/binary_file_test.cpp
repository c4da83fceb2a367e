#include "aureole/io/binary_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "aureole/base/error.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string refusal(const std::string& path) {
    try {
        const MappedFile file(path);
    } catch (const FileError& error) {
        EXPECT_EQ(error.file(), path);
        return error.what();
    }
    return "";
}

TEST(MappedFile, ShowsWhatWasWritten) {
    const TemporaryFolder folder;
    std::string content(70'001, 'x');
    content[5] = '\0';
    write_binary_file(folder.file("a.bin"), std::as_bytes(std::span(content)));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.bin"});
    MappedFile file(folder.file("a.bin"));
    EXPECT_EQ(text_of(file.bytes()), content);
    const MappedFile moved(std::move(file));
    EXPECT_EQ(text_of(moved.bytes()), content);
}

TEST(MappedFile, KeepsTheFileThatAnotherReplaces) {
    const TemporaryFolder folder;
    const std::string before(5000, 'a');
    const std::string after = "b";
    write_binary_file(folder.file("a.bin"), std::as_bytes(std::span(before)));
    const MappedFile file(folder.file("a.bin"));
    write_binary_file(folder.file("a.bin"), std::as_bytes(std::span(after)));
    EXPECT_EQ(text_of(file.bytes()), before);
    EXPECT_EQ(text_of(MappedFile(folder.file("a.bin")).bytes()), after);
}

TEST(MappedFile, WhatCannotBeMappedIsNamed) {
    const TemporaryFolder folder;
    EXPECT_THAT(refusal(folder.file("none.bin")), testing::HasSubstr("there is no such file"));
    std::filesystem::create_directory(folder.file("sub"));
    EXPECT_THAT(refusal(folder.file("sub")), testing::HasSubstr("folder"));
    write_bytes(folder.file("empty.bin"), "");
    EXPECT_THAT(refusal(folder.file("empty.bin")), testing::HasSubstr("is empty"));
    EXPECT_THAT(refusal("/dev/zero"), testing::HasSubstr("no plain file"));
}

TEST(BinaryFile, WritingIntoNowhereIsAFileError) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_binary_file(folder.file("none/a.bin"), {}), FileError);
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace aureole::io
