// A file is written whole or not at all.
#include "base/file.hpp"
#include "support/limited_child.hpp"
#include "support/temporary_folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <iterator>

namespace tidemark {
namespace {

namespace fs = std::filesystem;

size_t files_in(const TemporaryFolder& folder) {
    return size_t(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

std::string refusal(const Result<void>& written) {
    if (written)
        return "it was written";
    EXPECT_EQ(written.error().code, ErrorCode::write);
    return written.error().message;
}

/// What write_file says in a child process that may write files of at most `limit` bytes.
std::string refusal_under_limit(size_t limit, const fs::path& path, const std::string& text) {
    return in_limited_child(limit, [&] { return refusal(write_file(path, text)); });
}

TEST(WriteFile, writes_every_byte_and_nothing_else) {
    const TemporaryFolder folder;
    const std::string bytes = std::string("a\0b\n", 4) + std::string(300000, 'x');
    ASSERT_TRUE(write_file(folder / "a.txt", bytes));
    EXPECT_EQ(read_file(folder / "a.txt"), bytes);
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(WriteFile, replaces_what_was_there) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.txt", "a long text of before");
    ASSERT_TRUE(write_file(folder / "a.txt", "short"));
    EXPECT_EQ(read_file(folder / "a.txt"), "short");
}

TEST(WriteFile, a_place_that_cannot_hold_it) {
    const TemporaryFolder folder;
    const std::string missing = folder / "no/a.txt";
    EXPECT_EQ(refusal(write_file(missing, "x")), "cannot write '" + missing + "': No such file or directory");
    save_in_place(folder / "file");
    const std::string below_a_file = folder / "file/a.txt";
    EXPECT_EQ(refusal(write_file(below_a_file, "x")), "cannot write '" + below_a_file + "': Not a directory");
    fs::create_directory(folder / "d.txt");
    const std::string taken = folder / "d.txt";
    EXPECT_EQ(refusal(write_file(taken, "x")), "cannot write '" + taken + "': Is a directory");
    EXPECT_EQ(files_in(folder), 2u);
}

TEST(WriteFile, unwritable_folder) {
    if (::geteuid() == 0)
        GTEST_SKIP() << "root may write everywhere";
    const TemporaryFolder folder;
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    const std::string path = folder / "a.txt";
    EXPECT_EQ(refusal(write_file(path, "x")), "cannot write '" + path + "': Permission denied");
    fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST(WriteFile, a_folder_that_takes_no_files_even_from_root) {
    const std::string path = "/proc/a.txt";
    EXPECT_EQ(refusal(write_file(path, "x")), "cannot write '/proc/a.txt': No such file or directory");
}

TEST(WriteFile, a_full_disk_leaves_nothing_new) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    EXPECT_EQ(refusal_under_limit(1000, path, std::string(5000, 'x')),
              "cannot write '" + path + "': File too large");
    EXPECT_EQ(files_in(folder), 0u);
}

TEST(WriteFile, a_full_disk_leaves_the_old_as_it_was) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    save_in_place(path, "before");
    EXPECT_EQ(refusal_under_limit(1000, path, std::string(5000, 'x')),
              "cannot write '" + path + "': File too large");
    EXPECT_EQ(read_file(path), "before");
    EXPECT_EQ(files_in(folder), 1u);
    EXPECT_EQ(refusal_under_limit(1000, path, std::string(1000, 'x')), "it was written");
}

TEST(WriteFile, whether_a_file_could_be_written_is_known_before) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "a.txt", "kept"));
    EXPECT_TRUE(check_writable(folder / "a.txt"));
    EXPECT_TRUE(check_writable(folder / "new.txt"));
    EXPECT_TRUE(check_writable("/dev/full")); // a device is asked when it is written to
    EXPECT_EQ(files_in(folder), 1u);
    EXPECT_EQ(read_file(folder / "a.txt"), "kept");
    const std::string missing = (folder / "none/a.txt").string();
    EXPECT_EQ(refusal(check_writable(missing)), "cannot write '" + missing + "': No such file or directory");
    const std::string taken = folder.path().string();
    EXPECT_EQ(refusal(check_writable(taken)), "cannot write '" + taken + "': Is a directory");
}

TEST(WriteFile, a_pipe_takes_the_bytes_and_stays_a_pipe) {
    const TemporaryFolder folder;
    const fs::path path = folder / "pipe";
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    ASSERT_TRUE(write_file(path, "bytes"));
    char bytes[16];
    EXPECT_EQ(::read(reader, bytes, sizeof bytes), 5);
    ::close(reader);
    EXPECT_TRUE(fs::is_fifo(path));
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(WriteFile, a_device_that_is_full) {
    EXPECT_EQ(refusal(write_file("/dev/full", "x")), "cannot write '/dev/full': No space left on device");
}

TEST(WriteFile, a_link_stays_one) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.txt", "before");
    fs::create_symlink("a.txt", folder / "link");
    ASSERT_TRUE(write_file(folder / "link", "after"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_file(folder / "a.txt"), "after");
}

TEST(StagedFile, keeps_its_extension_beside_its_place) {
    const TemporaryFolder folder;
    const StagedFile staged(folder / "a.b.png");
    EXPECT_EQ(staged.path().parent_path(), folder.path());
    EXPECT_EQ(staged.path().extension(), ".png");
    EXPECT_EQ(staged.path().filename().string().front(), '.');
    EXPECT_NE(staged.path(), folder / "a.b.png");
}

TEST(StagedFile, two_for_one_place_are_two_files) {
    const TemporaryFolder folder;
    StagedFile first(folder / "a.png");
    StagedFile second(folder / "a.png");
    EXPECT_NE(first.path(), second.path());
}

TEST(StagedFile, goes_when_it_is_dropped) {
    const TemporaryFolder folder;
    {
        const StagedFile staged(folder / "a.png");
        save_in_place(staged.path());
        EXPECT_EQ(files_in(folder), 1u);
    }
    EXPECT_EQ(files_in(folder), 0u);
}

TEST(StagedFile, one_that_was_moved_has_one_owner) {
    const TemporaryFolder folder;
    StagedFile first(folder / "a.png");
    save_in_place(first.path(), "bytes");
    {
        StagedFile second(std::move(first));
        ASSERT_TRUE(second.commit());
    }
    EXPECT_EQ(read_file(folder / "a.png"), "bytes");
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(StagedFile, nothing_to_commit) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.png";
    EXPECT_EQ(refusal(StagedFile(path).commit()), "cannot write '" + path + "': No such file or directory");
}

} // namespace
} // namespace tidemark
