#include "aureole/io/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "aureole/base/error.h"
#include "io/test_support.h"

namespace aureole::io {
namespace {

std::string refusal(const std::string& path) {
    try {
        read_text_file(path);
    } catch (const FileError& error) {
        EXPECT_EQ(error.file(), path);
        return error.what();
    }
    return "";
}

TEST(TextFile, ComesBackByteForByte) {
    const TemporaryFolder folder;
    std::string text = "a\r\nb\n\xFF";
    text += std::string(200'000, 'x') + '\0';
    for (const std::string& content : {std::string(), text}) {
        write_text_file(folder.file("a.txt"), content);
        EXPECT_EQ(read_text_file(folder.file("a.txt")), content);
        EXPECT_EQ(read_bytes(folder.file("a.txt")), content);
    }
    EXPECT_EQ(folder.names(), std::vector<std::string>{"a.txt"});
}

TEST(TextFile, WhatCannotBeReadIsNamed) {
    const TemporaryFolder folder;
    EXPECT_THAT(refusal(folder.file("none.txt")), testing::HasSubstr("there is no such file"));
    std::filesystem::create_directory(folder.file("sub"));
    EXPECT_THAT(refusal(folder.file("sub")), testing::HasSubstr("folder"));
    // As long as it may be, and one byte more; a device without end.
    write_bytes(folder.file("long.txt"), std::string(kMostTextBytes, ' '));
    EXPECT_EQ(read_text_file(folder.file("long.txt")).size(), kMostTextBytes);
    write_bytes(folder.file("long.txt"), std::string(kMostTextBytes + 1, ' '));
    EXPECT_THAT(refusal(folder.file("long.txt")), testing::HasSubstr("longer than 16 MiB"));
    EXPECT_THAT(refusal("/dev/zero"), testing::HasSubstr("longer than 16 MiB"));
}

TEST(TextFile, WritingIntoNowhereIsAFileError) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_text_file(folder.file("none/a.txt"), "text"), FileError);
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace aureole::io
