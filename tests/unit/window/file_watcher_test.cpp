#include "support/temporary_folder.hpp"
#include "window/file_watcher.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <thread>

namespace tidemark::window::file_watcher_test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Paths = std::vector<fs::path>;
using testing::IsEmpty;

/// Counts the calls of `wake` and lets a test wait for one.
class Bell {
public:
    void ring() {
        const std::lock_guard lock(mutex_);
        ++rings_;
        rung_.notify_all();
    }
    bool wait_beyond(int rings, std::chrono::milliseconds limit) {
        std::unique_lock lock(mutex_);
        return rung_.wait_for(lock, limit, [&] { return rings_ > rings; });
    }
    int rings() {
        const std::lock_guard lock(mutex_);
        return rings_;
    }

private:
    std::mutex mutex_;
    std::condition_variable rung_;
    int rings_ = 0;
};

class FileWatcherTest : public testing::Test {
protected:
    void watch(const Paths& files) {
        const Result<void> watched = watcher_.watch(files);
        ASSERT_TRUE(watched) << watched.error().message;
    }
    /// Returns the next report within a second, or within `limit`.
    Paths next_change(std::chrono::milliseconds limit = 1s) {
        const auto end = Clock::now() + limit;
        for (;;) {
            const int rings = bell_.rings();
            if (Paths files = changed(); !files.empty())
                return files;
            const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
            if (left <= 0ms || !bell_.wait_beyond(rings, left))
                return changed();
        }
    }
    Paths changed() {
        Paths files;
        for (const FileWatcher::Change& change : watcher_.changed())
            files.push_back(change.file);
        return files;
    }
    /// Returns reports where none should come: waits long enough for every debounce but `k_patience`.
    Paths unexpected_change() { return next_change(60ms); }

    TemporaryFolder folder_;
    Bell bell_;
    FileWatcher watcher_ = *FileWatcher::create([this] { bell_.ring(); });
};

TEST_F(FileWatcherTest, reports_nothing_before_a_change) {
    save_in_place(folder_ / "a.glsl");
    watch({folder_ / "a.glsl"});
    EXPECT_THAT(unexpected_change(), IsEmpty());
    EXPECT_EQ(bell_.rings(), 0);
}

TEST_F(FileWatcherTest, file_written_in_place) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    save_in_place(file);
    EXPECT_EQ(next_change(), Paths{file});
    EXPECT_THAT(unexpected_change(), IsEmpty());
}

TEST_F(FileWatcherTest, files_added_to_and_removed_from_a_folder) {
    const fs::path inside = folder_ / "s/";
    fs::create_directory(inside);
    save_in_place(inside / "old.glsl");
    watch({inside});
    save_in_place(inside / "old.glsl");
    EXPECT_THAT(unexpected_change(), IsEmpty()) << "it has no other name";
    save_in_place(inside / "new.glsl");
    EXPECT_EQ(next_change(), Paths{inside});
    fs::remove(inside / "old.glsl");
    EXPECT_EQ(next_change(), Paths{inside});
    fs::rename(inside / "new.glsl", inside / "newer.glsl");
    EXPECT_EQ(next_change(), Paths{inside});
}

TEST_F(FileWatcherTest, file_replaced_by_renaming_again_and_again) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    for (int save = 0; save < 3; ++save) {
        save_and_rename(file);
        EXPECT_EQ(next_change(), Paths{file}) << save;
    }
}

TEST_F(FileWatcherTest, file_gone_for_a_moment_is_reported_when_it_is_back) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    fs::remove(file);
    EXPECT_THAT(next_change(40ms), IsEmpty());
    save_in_place(file);
    EXPECT_EQ(next_change(), Paths{file});
}

TEST_F(FileWatcherTest, file_emptied_and_written_later_is_reported_when_it_is_whole) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    save_in_place(file, "");
    EXPECT_THAT(next_change(40ms), IsEmpty());
    save_in_place(file);
    EXPECT_EQ(next_change(), Paths{file});
}

TEST_F(FileWatcherTest, file_gone_for_good_is_reported_after_a_delay) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    const auto start = Clock::now();
    fs::remove(file);
    EXPECT_EQ(next_change(5s), Paths{file});
    EXPECT_GE(Clock::now() - start, FileWatcher::k_patience - 1ms);
    save_in_place(file);
    EXPECT_EQ(next_change(), Paths{file});
}

/// Saves a few times, for longer than a watcher waits after one save; gives the longest pause in between.
Clock::duration save_often(const fs::path& file) {
    Clock::duration longest{};
    auto last = Clock::now();
    for (int save = 0; save < 15; ++save) {
        std::this_thread::sleep_for(1ms);
        save_in_place(file);
        longest = std::max(longest, Clock::now() - last);
        last = Clock::now();
    }
    return longest;
}

TEST_F(FileWatcherTest, rapid_writes_make_one_report) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    // On a busy machine this thread may have to pause between two writes: another try, then.
    for (int tries = 0; tries < 20; ++tries) {
        const int rings = bell_.rings();
        const bool without_pause = save_often(file) < FileWatcher::k_quiet - 1ms;
        EXPECT_EQ(next_change(), Paths{file});
        const Paths more = unexpected_change();
        if (!without_pause)
            continue;
        EXPECT_THAT(more, IsEmpty());
        EXPECT_EQ(bell_.rings(), rings + 1);
        return;
    }
    GTEST_SKIP() << "the machine is too busy to write without a pause";
}

TEST_F(FileWatcherTest, other_files_of_the_folder_are_ignored) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    save_in_place(folder_ / "b.glsl");
    save_and_rename(folder_ / "c.glsl");
    fs::remove(folder_ / "b.glsl");
    fs::create_directory(folder_ / "d");
    EXPECT_THAT(unexpected_change(), IsEmpty());
    EXPECT_EQ(bell_.rings(), 0);
}

TEST_F(FileWatcherTest, reading_a_file_is_not_reported) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    std::string word;
    std::ifstream(file) >> word;
    EXPECT_EQ(word, "text");
    EXPECT_THAT(unexpected_change(), IsEmpty());
}

TEST_F(FileWatcherTest, two_files_in_two_folders) {
    fs::create_directory(folder_ / "lib");
    const Paths files{folder_ / "a.glsl", folder_ / "lib/b.glsl"};
    save_in_place(files[0]);
    save_in_place(files[1]);
    watch(files);
    save_in_place(files[1]);
    EXPECT_EQ(next_change(), Paths{files[1]});
    save_in_place(files[0]);
    EXPECT_EQ(next_change(), Paths{files[0]});
    save_in_place(files[1]);
    save_in_place(files[0]);
    std::this_thread::sleep_for(60ms);
    EXPECT_EQ(changed(), files);
}

TEST_F(FileWatcherTest, target_of_a_link_and_the_link_itself) {
    fs::create_directory(folder_ / "real");
    save_in_place(folder_ / "real/a.glsl");
    save_in_place(folder_ / "real/b.glsl");
    const fs::path link = folder_ / "link.glsl";
    fs::create_symlink("real/a.glsl", link);
    watch({link});
    save_in_place(folder_ / "real/a.glsl");
    EXPECT_EQ(next_change(), Paths{link}) << "written through";
    save_and_rename(folder_ / "real/a.glsl");
    EXPECT_EQ(next_change(), Paths{link}) << "target replaced";
    fs::create_symlink("real/b.glsl", folder_ / "fresh");
    fs::rename(folder_ / "fresh", link);
    EXPECT_EQ(next_change(), Paths{link}) << "link replaced";
    save_in_place(folder_ / "real/b.glsl");
    EXPECT_EQ(next_change(), Paths{link}) << "new target";
    save_in_place(folder_ / "real/a.glsl");
    EXPECT_THAT(unexpected_change(), IsEmpty()) << "old target";
}

TEST_F(FileWatcherTest, linked_folder_with_a_changed_target) {
    fs::create_directory(folder_ / "one");
    fs::create_directory(folder_ / "two");
    save_in_place(folder_ / "one/a.glsl");
    save_in_place(folder_ / "two/a.glsl");
    fs::create_directory_symlink("one", folder_ / "current");
    const fs::path file = folder_ / "current/a.glsl";
    watch({file});
    fs::create_directory_symlink("two", folder_ / "fresh");
    fs::rename(folder_ / "fresh", folder_ / "current");
    EXPECT_EQ(next_change(), Paths{file});
    save_in_place(folder_ / "two/a.glsl");
    EXPECT_EQ(next_change(), Paths{file});
}

TEST_F(FileWatcherTest, folder_deleted_and_made_again) {
    fs::create_directories(folder_ / "outer/inner");
    const fs::path file = folder_ / "outer/inner/a.glsl";
    save_in_place(file);
    watch({file});
    for (int turn = 0; turn < 3; ++turn) {
        fs::remove_all(folder_ / "outer");
        std::this_thread::sleep_for(turn * 20ms);
        fs::create_directories(folder_ / "outer/inner");
        save_in_place(file);
        EXPECT_EQ(next_change(), Paths{file}) << turn;
        save_in_place(file);
        EXPECT_EQ(next_change(), Paths{file}) << turn;
    }
}

TEST_F(FileWatcherTest, folder_deleted_while_something_has_it_open) {
    fs::create_directory(folder_ / "scene");
    const fs::path file = folder_ / "scene/a.glsl";
    save_in_place(file);
    watch({file});
    for (const auto pause : {0ms, 0ms, 0ms, 20ms}) {
        const fs::directory_iterator open(folder_ / "scene");
        fs::remove(file);
        std::this_thread::sleep_for(pause);
        fs::remove(folder_ / "scene");
        std::this_thread::sleep_for(pause);
        fs::create_directory(folder_ / "scene");
        std::this_thread::sleep_for(pause);
        save_in_place(file);
        EXPECT_EQ(next_change(), Paths{file});
        save_in_place(file);
        EXPECT_EQ(next_change(), Paths{file});
    }
}

TEST_F(FileWatcherTest, folder_swapped_for_another) {
    fs::create_directory(folder_ / "scene");
    fs::create_directory(folder_ / "other");
    const fs::path file = folder_ / "scene/a.glsl";
    save_in_place(file);
    save_in_place(folder_ / "other/a.glsl");
    watch({file});
    fs::rename(folder_ / "scene", folder_ / "old");
    fs::rename(folder_ / "other", folder_ / "scene");
    EXPECT_EQ(next_change(), Paths{file});
    save_in_place(file);
    EXPECT_EQ(next_change(), Paths{file});
    save_in_place(folder_ / "old/a.glsl");
    EXPECT_THAT(unexpected_change(), IsEmpty());
}

TEST_F(FileWatcherTest, file_with_its_folders_name) {
    fs::create_directory(folder_ / "water");
    const fs::path file = folder_ / "water/water";
    save_in_place(file);
    watch({file});
    for (int save = 0; save < 3; ++save) {
        save_and_rename(file);
        EXPECT_EQ(next_change(), Paths{file}) << save;
    }
}

TEST_F(FileWatcherTest, file_that_does_not_exist_yet) {
    const fs::path file = folder_ / "x/y/a.glsl";
    watch({file});
    EXPECT_THAT(unexpected_change(), IsEmpty());
    fs::create_directories(folder_ / "x/y");
    save_in_place(file);
    EXPECT_EQ(next_change(), Paths{file});
}

TEST_F(FileWatcherTest, a_new_set_of_files_replaces_the_old_set) {
    const Paths files{folder_ / "a.glsl", folder_ / "b.glsl", folder_ / "c.glsl"};
    for (const fs::path& file : files)
        save_in_place(file);
    watch({files[0], files[1]});
    save_in_place(files[0]);
    save_in_place(files[1]);
    std::this_thread::sleep_for(60ms);
    watch({files[1], files[2]});
    EXPECT_EQ(changed(), Paths{files[1]}) << "known of a file that stays";
    save_in_place(files[0]);
    EXPECT_THAT(unexpected_change(), IsEmpty());
    save_in_place(files[2]);
    EXPECT_EQ(next_change(), Paths{files[2]});
    watch({});
    save_in_place(files[2]);
    EXPECT_THAT(unexpected_change(), IsEmpty());
}

TEST_F(FileWatcherTest, the_same_set_in_another_order_is_kept) {
    const Paths files{folder_ / "a.glsl", folder_ / "b.glsl"};
    watch(files);
    const auto start = Clock::now();
    for (int turn = 0; turn < 1000; ++turn)
        watch({files[1], files[0], files[1]});
    EXPECT_LT(Clock::now() - start, 500ms);
}

TEST_F(FileWatcherTest, paths_keep_their_spelling) {
    const fs::path before = fs::current_path();
    fs::current_path(folder_.path());
    save_in_place("a.glsl");
    watch({"./a.glsl"});
    fs::current_path(before);
    save_in_place(folder_ / "a.glsl");
    EXPECT_EQ(next_change(), Paths{"./a.glsl"});
}

TEST_F(FileWatcherTest, a_moved_watcher_continues) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    FileWatcher moved = std::move(watcher_);
    watcher_ = std::move(moved);
    save_in_place(file);
    EXPECT_EQ(next_change(), Paths{file});
}

TEST_F(FileWatcherTest, sleeps_without_events) {
    save_in_place(folder_ / "a.glsl");
    watch({folder_ / "a.glsl"});
    const std::clock_t before = std::clock();
    std::this_thread::sleep_for(300ms);
    EXPECT_LT(double(std::clock() - before) / CLOCKS_PER_SEC, 0.03);
}

/// Leaves the process without a free file descriptor.
class NoMoreDescriptors {
public:
    NoMoreDescriptors() {
        getrlimit(RLIMIT_NOFILE, &before_);
        rlimit none = before_;
        none.rlim_cur = 0;
        setrlimit(RLIMIT_NOFILE, &none);
    }
    NoMoreDescriptors(const NoMoreDescriptors&) = delete;
    NoMoreDescriptors& operator=(const NoMoreDescriptors&) = delete;
    ~NoMoreDescriptors() { setrlimit(RLIMIT_NOFILE, &before_); }

private:
    rlimit before_{};
};

TEST_F(FileWatcherTest, running_out_of_descriptors_is_an_error_that_can_be_retried) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer itself needs descriptors to look at an object";
#endif
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    {
        const NoMoreDescriptors none;
        const Result<FileWatcher> second = FileWatcher::create();
        ASSERT_FALSE(second);
        EXPECT_EQ(second.error().code, ErrorCode::load);
        EXPECT_EQ(second.error().message,
                  "cannot watch files for changes: too many open files (raise `ulimit -n` or "
                  "fs.inotify.max_user_instances)");
        const Result<void> watched = watcher_.watch(Paths{file});
        ASSERT_FALSE(watched);
        EXPECT_EQ(watched.error().message,
                  fmt::format("cannot watch '{}' for changes: too many open files (raise `ulimit -n` or "
                              "fs.inotify.max_user_instances)",
                              folder_.path().string()));
    }
    watch({file});
    save_in_place(file);
    EXPECT_EQ(next_change(), Paths{file});
}

TEST_F(FileWatcherTest, moved_files_have_the_time_of_the_move) {
    const std::pair<const char*, const char*> moves[] = {{"a.glsl", "a.glsl"}, {"b/c.glsl", "b"}};
    for (const auto& [name, moved] : moves) {
        const fs::path file = folder_ / name;
        const fs::path old = folder_ / fmt::format("old/{}", name);
        fs::create_directories(file.parent_path());
        fs::create_directories(old.parent_path());
        save_in_place(file);
        save_in_place(old);
        fs::last_write_time(old, fs::file_time_type::clock::now() - 1h);
        watch({file});
        const auto before = Clock::now();
        fs::remove_all(folder_ / moved);
        fs::rename(folder_ / fmt::format("old/{}", moved), folder_ / moved);
        std::vector<FileWatcher::Change> changes;
        while (changes.empty() && Clock::now() < before + 10s)
            changes = watcher_.changed();
        ASSERT_EQ(changes.size(), 1U) << name;
        EXPECT_GE(changes[0].at, before) << name;
        EXPECT_LE(changes[0].at, Clock::now()) << name;
    }
}

/// The time from the end of a save to the call of `wake`; it is printed, and its bound is loose.
TEST_F(FileWatcherTest, latency) {
    const fs::path file = folder_ / "a.glsl";
    save_in_place(file);
    watch({file});
    std::vector<double> milliseconds;
    for (int save = 0; save < 40; ++save) {
        const int rings = bell_.rings();
        save % 2 ? save_in_place(file) : save_and_rename(file);
        const auto saved = Clock::now();
        ASSERT_TRUE(bell_.wait_beyond(rings, 1s));
        milliseconds.push_back(std::chrono::duration<double, std::milli>(Clock::now() - saved).count());
        EXPECT_EQ(changed(), Paths{file});
    }
    std::ranges::sort(milliseconds);
    fmt::print("save to report: median {:.2f} ms, slowest of {} {:.2f} ms\n",
               milliseconds[milliseconds.size() / 2], milliseconds.size(), milliseconds.back());
    EXPECT_LT(milliseconds.back(), 1000);
}

} // namespace tidemark::window::file_watcher_test
