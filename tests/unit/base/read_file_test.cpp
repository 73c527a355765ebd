// Errors of read_file for paths that are not readable files.
#include "base/file.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tidemark::read_file_test {

namespace fs = std::filesystem;

std::string refusal(const Result<std::string>& read) {
    if (read)
        return "it was read";
    EXPECT_EQ(read.error().code, ErrorCode::load);
    EXPECT_TRUE(read.error().diagnostics.empty());
    return read.error().message;
}

TEST(ReadFile, gives_every_byte) {
    const TemporaryFolder folder;
    const std::string bytes = std::string("\xEF\xBB\xBF a\r\n\0\xff", 9) + std::string(200000, 'x');
    save_in_place(folder / "a", bytes);
    EXPECT_EQ(read_file(folder / "a"), bytes);
    save_in_place(folder / "empty", "");
    EXPECT_EQ(read_file(folder / "empty"), "");
}

TEST(ReadFile, missing) {
    const TemporaryFolder folder;
    const std::string path = folder / "no.glsl";
    EXPECT_EQ(refusal(read_file(path)), "cannot read '" + path + "': no such file");
    EXPECT_EQ(refusal(read_file("")), "cannot read '': no such file");
}

TEST(ReadFile, a_file_taken_for_a_folder_is_missing) {
    const TemporaryFolder folder;
    save_in_place(folder / "a");
    const std::string path = folder / "a/b.glsl";
    EXPECT_EQ(refusal(read_file(path)), "cannot read '" + path + "': no such file");
}

TEST(ReadFile, directory) {
    const TemporaryFolder folder;
    const std::string path = folder.path();
    EXPECT_EQ(refusal(read_file(path)), "cannot read '" + path + "': it is a directory");
}

TEST(ReadFile, a_pipe_is_refused_and_not_waited_for) {
    const TemporaryFolder folder;
    const std::string path = folder / "pipe";
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    EXPECT_EQ(refusal(read_file(path)), "cannot read '" + path + "': it is not a regular file");
    EXPECT_EQ(refusal(read_file("/dev/null")), "cannot read '/dev/null': it is not a regular file");
}

TEST(ReadFile, without_permission) {
    if (::geteuid() == 0)
        GTEST_SKIP() << "root may read everything";
    const TemporaryFolder folder;
    const std::string path = folder / "a";
    save_in_place(path);
    fs::permissions(path, fs::perms::none);
    EXPECT_EQ(refusal(read_file(path)), "cannot read '" + path + "': Permission denied");
}

TEST(ReadFile, circular_links) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    const std::string path = folder / "a";
    EXPECT_EQ(refusal(read_file(path)), "cannot read '" + path + "': Too many levels of symbolic links");
}

TEST(ReadFile, larger_than_allowed) {
    const TemporaryFolder folder;
    const std::string path = folder / "a";
    save_in_place(path, std::string((1u << 20) + 1, 'x'));
    EXPECT_EQ(refusal(read_file(path, 1u << 20)), "cannot read '" + path + "': it is larger than 1 MiB");
    save_in_place(path, std::string(1u << 20, 'x'));
    EXPECT_EQ(read_file(path, 1u << 20)->size(), 1u << 20);
}

TEST(ReadFile, too_large_files_are_refused_before_reading) {
    const TemporaryFolder folder;
    const std::string path = folder / "sparse";
    save_in_place(path, "");
    fs::resize_file(path, uintmax_t{1} << 40);
    EXPECT_EQ(refusal(read_file(path)), "cannot read '" + path + "': it is larger than 16 MiB");
}

TEST(ReadFile, a_file_without_a_size_is_read) {
    EXPECT_EQ(read_file("/proc/self/comm"), "unit_base\n");
}

TEST(ReadFile, a_dangling_link_names_its_target) {
    const TemporaryFolder folder;
    fs::create_symlink("none", folder / "a");
    fs::create_symlink("/none", folder / "b");
    const std::string a = folder / "a", below = folder / "b/c.glsl", b = folder / "b";
    EXPECT_EQ(refusal(read_file(a)), "cannot read '" + a + "': it is a link to 'none', which does not exist");
    EXPECT_EQ(refusal(read_file(below)),
              "cannot read '" + below + "': '" + b + "' is a link to '/none', which does not exist");
}

TEST(ReadFile, invalid_file_names) {
    using namespace std::string_literals;
    EXPECT_EQ(refusal(read_file("a\0b"s)), "cannot read 'a\0b': there is a zero byte in its name"s);
    const std::string longest(256, 'x');
    EXPECT_EQ(refusal(read_file(longest)), "cannot read '" + longest + "': File name too long");
}

TEST(ReadTextFile, a_binary_file_is_refused) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.glsl";
    save_in_place(path, std::string_view("void\0main", 9));
    EXPECT_EQ(refusal(read_text_file(path)), "'" + path + "' is a binary file, not shader text");
    save_in_place(path, "caf\xc3\xa9 \xff");
    EXPECT_EQ(read_text_file(path), "caf\xc3\xa9 \xff");
}

TEST(ReadTextFile, an_unreadable_file_is_reported_as_unreadable) {
    EXPECT_EQ(refusal(read_text_file("no.glsl")), "cannot read 'no.glsl': no such file");
}

} // namespace tidemark::read_file_test
