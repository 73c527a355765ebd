// A file is written whole or not at all.
#include "base/file.hpp"
#include "support/limited_child.hpp"
#include "support/temporary_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <iterator>

namespace tidemark::write_file_test {

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

/// Returns the error of write_file in a child process that may write files of at most `limit` bytes.
std::string refusal_under_limit(size_t limit, const fs::path& path, const std::string& text) {
    return in_limited_child(limit, [&] { return refusal(write_file(path, text)); });
}

TEST(WriteFile, writes_every_byte_and_no_other_file) {
    const TemporaryFolder folder;
    const std::string bytes = std::string("a\0b\n", 4) + std::string(300000, 'x');
    ASSERT_TRUE(write_file(folder / "a.txt", bytes));
    EXPECT_EQ(read_file(folder / "a.txt"), bytes);
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(WriteFile, replaces_an_existing_file) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.txt", "a long text of before");
    ASSERT_TRUE(write_file(folder / "a.txt", "short"));
    EXPECT_EQ(read_file(folder / "a.txt"), "short");
}

TEST(WriteFile, unwritable_places_are_errors) {
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

TEST(ReplaceText, mode_and_names_stay) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.glsl";
    ASSERT_TRUE(write_file(path, "before"));
    for (const mode_t mode : {0600, 0640, 0755}) {
        ASSERT_EQ(::chmod(path.c_str(), mode), 0);
        ASSERT_TRUE(replace_text(OutputPath::typed(path), *read_file(path), fmt::format("mode {:o}", mode)));
        struct stat facts {};
        ASSERT_EQ(::stat(path.c_str(), &facts), 0);
        EXPECT_EQ(facts.st_mode & 07777, mode);
        EXPECT_EQ(read_file(path), fmt::format("mode {:o}", mode));
    }
    const std::string other = folder / "b.glsl";
    fs::create_hard_link(path, other);
    ASSERT_TRUE(replace_text(OutputPath::typed(path), "mode 755", "short"));
    EXPECT_EQ(read_file(other), "short");
    EXPECT_EQ(fs::hard_link_count(path), 2u);
    EXPECT_EQ(files_in(folder), 2u);
}

TEST(ReplaceText, changed_and_read_only_files_stay) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.glsl";
    ASSERT_TRUE(write_file(path, "edited"));
    EXPECT_EQ(refusal(replace_text(OutputPath::typed(path), "before", "after")),
              "'" + path + "' changed on disk meanwhile; nothing was written");
    ASSERT_EQ(::chmod(path.c_str(), 0444), 0);
    EXPECT_EQ(refusal(replace_text(OutputPath::typed(path), "edited", "after")),
              "cannot write '" + path + "': it is read-only");
    EXPECT_EQ(read_file(path), "edited");
    fs::remove(path);
    EXPECT_EQ(refusal(replace_text(OutputPath::typed(path), "edited", "after")),
              "cannot write '" + path + "': No such file or directory");
    EXPECT_EQ(files_in(folder), 0u) << "what was deleted does not come back";
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

TEST(WriteFile, a_full_disk_leaves_no_new_file) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    EXPECT_EQ(refusal_under_limit(1000, path, std::string(5000, 'x')),
              "cannot write '" + path + "': File too large");
    EXPECT_EQ(files_in(folder), 0u);
}

TEST(WriteFile, a_full_disk_keeps_the_old_file) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    save_in_place(path, "before");
    EXPECT_EQ(refusal_under_limit(1000, path, std::string(5000, 'x')),
              "cannot write '" + path + "': File too large");
    EXPECT_EQ(read_file(path), "before");
    EXPECT_EQ(files_in(folder), 1u);
    EXPECT_EQ(refusal_under_limit(1000, path, std::string(1000, 'x')), "it was written");
}

TEST(WriteFile, check_writable_predicts_write_errors) {
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

TEST(WriteFile, a_link_named_by_the_user_is_followed) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.txt", "before");
    fs::create_symlink("a.txt", folder / "link");
    ASSERT_TRUE(write_file(OutputPath::typed(folder / "link"), "after"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_file(folder / "a.txt"), "after");
    fs::create_symlink("new.txt", folder / "nowhere");
    ASSERT_TRUE(write_file(OutputPath::typed(folder / "nowhere"), "new"));
    EXPECT_TRUE(fs::is_symlink(folder / "nowhere"));
    EXPECT_EQ(read_file(folder / "new.txt"), "new");
}

std::string links_sentence(const std::string& path, const std::string& link, const std::string& target) {
    return "cannot write '" + path + "': " + (link == path ? "it" : "'" + link + "'") + " is a link to '" +
           target + "', and only links named with -o are followed: remove the link, or give another name";
}

TEST(WriteFile, a_link_not_named_by_the_user_is_not_followed) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.txt", "before");
    const std::string target = folder / "a.txt", link = folder / "link", loop = folder / "loop";
    fs::create_symlink(target, link);
    fs::create_symlink("nowhere", folder / "dangling");
    fs::create_symlink("loop", loop);
    EXPECT_EQ(refusal(write_file(link, "x")), links_sentence(link, link, target));
    EXPECT_EQ(refusal(check_writable(link)), links_sentence(link, link, target));
    const std::string dangling = folder / "dangling";
    EXPECT_EQ(refusal(write_file(dangling, "x")), links_sentence(dangling, dangling, "nowhere"));
    EXPECT_EQ(refusal(write_file(loop, "x")), links_sentence(loop, loop, "loop"));
    EXPECT_EQ(refusal(write_file(OutputPath::typed(loop), "x")),
              "cannot write '" + loop + "': Too many levels of symbolic links");
    EXPECT_EQ(read_file(folder / "a.txt"), "before");
    EXPECT_EQ(files_in(folder), 4u);
}

TEST(WriteFile, a_linked_folder_not_named_by_the_user_is_not_followed) {
    const TemporaryFolder folder, elsewhere;
    fs::create_directory_symlink(elsewhere.path(), folder / "own");
    const OutputPath own = OutputPath::typed(folder / "own"), ours(folder / "own");
    EXPECT_TRUE(make_folder(own / "maps"));
    ASSERT_TRUE(write_file(own / "maps" / "a.txt", "x")); // the person's link
    EXPECT_EQ(read_file(elsewhere / "maps/a.txt"), "x");
    const std::string link = folder / "own", target = elsewhere.path();
    EXPECT_EQ(refusal(make_folder(ours)), links_sentence(link, link, target));
    EXPECT_EQ(refusal(write_file(ours / "b.txt", "x")), links_sentence(link + "/b.txt", link, target));
    fs::remove_all(elsewhere / "maps");
    fs::create_directory_symlink(folder.path(), elsewhere / "maps");
    EXPECT_EQ(refusal(write_file(own / "maps/b.txt", "x")),
              links_sentence(link + "/maps/b.txt", link + "/maps", folder.path()));
    EXPECT_EQ(refusal(make_folder(own / "maps")),
              links_sentence(link + "/maps", link + "/maps", folder.path()));
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(WriteFile, a_name_does_not_lead_out_of_its_folder) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "in");
    const OutputPath in = OutputPath::typed(folder / "in");
    const std::string whole = folder / "in/../a.txt";
    EXPECT_EQ(refusal(write_file(in / "../a.txt", "x")),
              "cannot write '" + whole + "': the name leads out of its folder");
    EXPECT_EQ((in / "/a.txt").path(), folder / "in/a.txt");
}

TEST(WriteFile, files_read_by_the_command_are_not_replaced) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.txt", "read");
    fs::create_symlink("a.txt", folder / "link");
    const std::string path = folder / "a.txt", link = folder / "link";
    const auto sentence = [](const std::string& name) {
        return "cannot write '" + name + "': this command reads that file; give another name with -o";
    };
    const std::vector<fs::path> read{folder / "none", folder / "a.txt"};
    EXPECT_EQ(refusal(write_file(OutputPath(path).sparing(read), "x")), sentence(path));
    EXPECT_EQ(refusal(write_file(OutputPath::typed(link).sparing(read), "x")), sentence(link));
    EXPECT_EQ(refusal(write_file(OutputPath::typed(folder.path()).sparing(read) / "a.txt", "x")),
              sentence(path));
    EXPECT_EQ(refusal(write_file(OutputPath(path).sparing({folder / "link"}), "x")), sentence(path));
    EXPECT_EQ(read_file(folder / "a.txt"), "read");
    EXPECT_TRUE(write_file(OutputPath(folder / "b.txt").sparing(read), "x"));
}

TEST(WriteFile, a_descriptor_of_this_process_by_its_name) {
    const TemporaryFolder folder;
    const int file = ::open((folder / "a.txt").c_str(), O_RDWR | O_CREAT, 0600);
    ASSERT_GE(file, 0);
    ASSERT_EQ(::write(file, "before ", 7), 7);
    const std::string number = std::to_string(file);
    ASSERT_TRUE(write_file(OutputPath::typed("/dev/fd/" + number), "after"));
    fs::create_symlink("/proc/self/fd/" + number, folder / "link");
    ASSERT_TRUE(write_file(OutputPath::typed(folder / "link"), "wards"));
    EXPECT_EQ(read_file(folder / "a.txt"), "before afterwards"); // not from the beginning, and no other file
    ::close(file);
    EXPECT_EQ(refusal(write_file(OutputPath::typed("/dev/fd/" + number), "x")),
              "cannot write '/dev/fd/" + number + "': Bad file descriptor");
}

TEST(WriteFile, longest_name) {
    const TemporaryFolder folder;
    const std::string name = std::string(251, 'n') + ".txt";
    ASSERT_TRUE(write_file(folder / name, "x"));
    EXPECT_EQ(files_in(folder), 1u);
    const std::string too_long = folder / ("n" + name);
    EXPECT_EQ(refusal(write_file(too_long, "x")), "cannot write '" + too_long + "': File name too long");
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(StagedFile, keeps_its_extension_beside_its_place) {
    const TemporaryFolder folder;
    const auto staged = StagedFile::create(folder / "a.b.png");
    ASSERT_TRUE(staged);
    EXPECT_EQ(staged->path().parent_path(), folder.path());
    EXPECT_EQ(staged->path().extension(), ".png");
    EXPECT_EQ(staged->path().filename().string().front(), '.');
    EXPECT_NE(staged->path(), folder / "a.b.png");
    EXPECT_EQ(StagedFile::create(folder / "a.mp4", ".wav")->path().extension(), ".wav");
    fs::create_symlink("film", folder / "link.mp4"); // ffmpeg goes by the extension
    EXPECT_EQ(StagedFile::create(OutputPath::typed(folder / "link.mp4"))->path().extension(), ".mp4");
}

TEST(StagedFile, two_staged_files_of_one_place_differ) {
    const TemporaryFolder folder;
    const auto first = StagedFile::create(folder / "a.png"), second = StagedFile::create(folder / "a.png");
    ASSERT_TRUE(first && second);
    EXPECT_NE(first->path(), second->path());
}

TEST(StagedFile, destruction_removes_the_staged_file) {
    const TemporaryFolder folder;
    {
        const auto staged = StagedFile::create(folder / "a.png");
        EXPECT_EQ(files_in(folder), 1u);
    }
    EXPECT_EQ(files_in(folder), 0u);
}

TEST(StagedFile, a_moved_file_has_one_owner) {
    const TemporaryFolder folder;
    auto first = StagedFile::create(folder / "a.png");
    ASSERT_TRUE(first);
    save_in_place(first->path(), "bytes");
    {
        StagedFile second(*std::move(first));
        ASSERT_TRUE(second.commit());
    }
    EXPECT_EQ(read_file(folder / "a.png"), "bytes");
    EXPECT_EQ(files_in(folder), 1u);
}

TEST(StagedFile, commit_of_a_removed_file_fails) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.png";
    auto staged = StagedFile::create(path);
    ASSERT_TRUE(staged);
    fs::remove(staged->path());
    EXPECT_EQ(refusal(staged->commit()), "cannot write '" + path + "': No such file or directory");
}

TEST(StagedFile, staged_bytes_are_copied_into_a_device) {
    const TemporaryFolder folder;
    fs::create_symlink("/dev/full", folder / "a.mp4");
    const std::string path = folder / "a.mp4";
    auto staged = StagedFile::create(OutputPath::typed(path));
    ASSERT_TRUE(staged);
    EXPECT_EQ(staged->path().extension(), ".mp4");
    EXPECT_NE(staged->path().parent_path(), "/dev");
    ASSERT_TRUE(staged->write(std::as_bytes(std::span("bytes"))));
    EXPECT_EQ(refusal(staged->commit()), "cannot write '" + path + "': No space left on device");
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

/// Returns the number of a process that has ended.
pid_t gone() {
    const pid_t child = ::fork();
    if (child == 0)
        ::_exit(0);
    ::waitpid(child, nullptr, 0);
    return child;
}

/// The digits that stand for the machine in the name of a file under construction, and a dash.
std::string machine_in(const fs::path& staged) {
    const std::string name = staged.filename().string();
    const size_t part = name.find(".part-") + 6;
    return name.substr(part, name.find('-', part) + 1 - part);
}

TEST(StagedFile, leftovers_of_a_killed_process_are_removed) {
    const TemporaryFolder folder;
    const std::string machine = machine_in(StagedFile::create(folder / "own.png")->path());
    const std::string dead = machine + std::to_string(gone()), alive = machine + std::to_string(::getppid());
    const std::string elsewhere = "01234567-" + std::to_string(gone());
    save_in_place(folder / (".a.0007.part-" + dead + "-3.png"));
    const std::vector<std::string> kept{
        ".a.part-" + alive + "-3.png",         ".b.part-" + dead + "-3.png", ".a.part-" + dead + ".png",
        "a.part-" + dead + "-3.png",           ".a.part-" + dead + "-x.png", ".a.notes",
        ".a.0003.part-" + elsewhere + "-3.png"};
    for (const std::string& name : kept)
        save_in_place(folder / name);
    fs::create_symlink("a.part", folder / (".a.part-" + dead + "-9.png"));
    const int held = ::open((folder / (".a.part-" + dead + "-5.png")).c_str(), O_RDWR | O_CREAT, 0600);
    ASSERT_EQ(::flock(held, LOCK_EX), 0); // by a process that this machine does not know
    ASSERT_TRUE(write_file(folder / "a.0012.png", "x"));
    for (const std::string& name : kept)
        EXPECT_TRUE(fs::exists(folder / name)) << name;
    EXPECT_EQ(files_in(folder), kept.size() + 3);
    StagedFile::remove_abandoned(folder / "a.0012.png", StagedFile::Machines::all);
    EXPECT_EQ(files_in(folder), kept.size() + 2) << "that of another machine";
    ::close(held);
}

TEST(StagedFile, an_existing_temporary_name_is_not_opened) {
    const TemporaryFolder folder;
    save_in_place(folder / "victim", "before");
    const auto first = StagedFile::create(folder / "a.png");
    ASSERT_TRUE(first);
    // The next names, as anybody could guess them.
    const std::string name = first->path().filename().string();
    const size_t dash = name.rfind('-'), dot = name.rfind('.');
    const int number = std::stoi(name.substr(dash + 1, dot - dash - 1));
    for (int i = 1; i <= 20; ++i)
        fs::create_symlink("victim",
                           folder / (name.substr(0, dash + 1) + std::to_string(number + i) + ".png"));
    ASSERT_TRUE(write_file(folder / "a.png", "x"));
    EXPECT_EQ(read_file(folder / "victim"), "before");
    EXPECT_EQ(read_file(folder / "a.png"), "x");
}

TEST(StagedFile, a_parent_removes_the_file_of_a_killed_child) {
    const TemporaryFolder folder;
    clear_leftovers_on_signals(); // before the fork
    const auto own = StagedFile::create(folder / "own.png");
    const pid_t child = ::fork();
    if (child == 0) {
        const auto staged = StagedFile::create(folder / "a.png");
        ::raise(SIGKILL);
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(files_in(folder), 2u);
    clear_leftovers_of_the_dead();
    EXPECT_EQ(files_in(folder), 1u);
    EXPECT_TRUE(fs::exists(own->path()));
}

/// Returns the number of files that a child leaves in the folder when the signal ends it during its work.
size_t left_by_child(const TemporaryFolder& folder, int signal) {
    int ready[2];
    EXPECT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        clear_leftovers_on_signals();
        const auto staged = StagedFile::create(folder / "a.png");
        const pid_t helper = ::fork();
        if (helper == 0) {
            ::setpgid(0, 0);
            ::pause();
        }
        ::setpgid(helper, helper);
        const Leftover kept = Leftover::child(helper);
        [[maybe_unused]] const ssize_t told = ::write(ready[1], &helper, sizeof helper);
        for (;;)
            ::pause();
    }
    pid_t helper = 0;
    EXPECT_EQ(::read(ready[0], &helper, sizeof helper), ssize_t(sizeof helper));
    EXPECT_EQ(files_in(folder), 1u);
    ::kill(child, signal);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (signal == SIGQUIT)
        EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    else
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 130);
    EXPECT_EQ(::kill(helper, 0), -1); // the program that it had started
    ::close(ready[0]);
    ::close(ready[1]);
    return files_in(folder);
}

TEST(StagedFile, a_signal_removes_the_staged_file) {
    const TemporaryFolder folder;
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM})
        EXPECT_EQ(left_by_child(folder, signal), 0u) << signal;
}

} // namespace tidemark::write_file_test
