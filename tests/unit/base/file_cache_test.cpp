#include "base/encoding.hpp"
#include "base/folders.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

namespace tidemark::file_cache_test {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr uint64_t k_plenty = 1 << 20;

/// A key by a short name.
std::string key(std::string_view name) {
    return sha256(std::as_bytes(std::span(name)));
}

size_t files_in(const fs::path& folder) {
    return size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(FileCache, returns_stored_bytes) {
    const TemporaryFolder folder;
    const FileCache cache(folder / "made/when/needed", k_plenty);
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
    const std::string bytes("a\0b\xff\n", 5);
    cache.keep(key("a"), bytes);
    cache.keep(key("b"), "");
    EXPECT_EQ(cache.find(key("a")), bytes);
    EXPECT_EQ(cache.find(key("b")), "");
    EXPECT_EQ(FileCache(folder / "made/when/needed", k_plenty).find(key("a")), bytes) << "in the next run";
    cache.keep(key("a"), "other");
    EXPECT_EQ(cache.find(key("a")), "other");
}

TEST(FileCache, damaged_entries_are_misses) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), k_plenty);
    cache.keep(key("a"), "some bytes of a program");
    const std::string whole = bytes_of(folder / key("a"));
    for (size_t i = 0; i < whole.size(); ++i) {
        std::string turned = whole;
        turned[i] = char(turned[i] ^ 1);
        save_in_place(folder / key("a"), turned);
        EXPECT_EQ(cache.find(key("a")), std::nullopt) << "bit turned in byte " << i;
        save_in_place(folder / key("a"), whole.substr(0, i));
        EXPECT_EQ(cache.find(key("a")), std::nullopt) << "cut to " << i << " bytes";
    }
    save_in_place(folder / key("a"), whole + "x");
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
    save_in_place(folder / key("a"), whole);
    EXPECT_EQ(cache.find(key("a")), "some bytes of a program");
}

TEST(FileCache, unwritable_folders_are_ignored) {
    const TemporaryFolder folder;
    save_in_place(folder / "file");
    const FileCache cache(folder / "file/below", k_plenty);
    cache.keep(key("a"), "bytes");
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
    fs::create_directory(folder / key("taken"));
    const FileCache with_folder(folder.path(), k_plenty);
    with_folder.keep(key("taken"), "bytes");
    EXPECT_EQ(with_folder.find(key("taken")), std::nullopt);
}

TEST(FileCache, least_recently_used_entries_are_removed_first) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), 1000);
    const std::string bytes(100, 'x'); // 164 with its digest: six of them fit
    for (const char* name : {"a", "b", "c", "d", "e", "f"})
        cache.keep(key(name), bytes);
    const auto now = fs::file_time_type::clock::now();
    int age = 100;
    for (const char* name : {"a", "b", "c", "d", "e", "f"})
        fs::last_write_time(folder / key(name), now - std::chrono::seconds(age--));
    EXPECT_EQ(cache.find(key("a")), bytes); // and is young again
    cache.keep(key("g"), bytes);
    EXPECT_EQ(cache.find(key("b")), std::nullopt);
    for (const char* name : {"a", "c", "d", "e", "f", "g"})
        EXPECT_EQ(cache.find(key(name)), bytes) << name;
    cache.keep(key("huge"), std::string(501, 'x'));
    EXPECT_EQ(cache.find(key("huge")), std::nullopt) << "it would push out most others";
    EXPECT_EQ(files_in(folder.path()), 6u);
}

TEST(FileCache, small_entries_are_removed_many_at_a_time) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), 25'600);
    size_t most = 0;
    for (int i = 0; i < 600; ++i) { // 256 of them fit
        cache.keep(key(std::to_string(i)), std::string(36, 'x'));
        if (i % 8 == 0)
            most = std::max(most, files_in(folder.path()));
    }
    EXPECT_GT(most, 258u) << "a look at each one would cost more than to keep it";
    EXPECT_LT(most, 350u);
    EXPECT_TRUE(cache.find(key("599")));
}

TEST(FileCache, partial_files_of_dead_processes_are_removed) {
    const TemporaryFolder folder;
    const fs::path half = folder / ("." + key("a") + ".part-1-1");
    save_in_place(half, std::string(900, 'x'));
    fs::last_write_time(half, fs::file_time_type::clock::now() - 1h);
    const FileCache cache(folder.path(), 1000);
    cache.keep(key("a"), std::string(200, 'y'));
    EXPECT_FALSE(fs::exists(half));
    EXPECT_EQ(cache.find(key("a")), std::string(200, 'y'));
}

TEST(FileCache, concurrent_writers_leave_a_whole_entry) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), 4000); // so that they also throw away each other's
    std::atomic<int> wrong = 0;
    std::vector<std::thread> writers;
    for (char name = 'a'; name < 'e'; ++name)
        writers.emplace_back([&, name] {
            for (int i = 0; i < 50; ++i) {
                const std::string wanted = key(std::to_string(i % 7));
                cache.keep(wanted, std::string(500, name));
                if (const auto found = cache.find(wanted))
                    wrong += *found != std::string(500, found->front());
            }
        });
    for (std::thread& writer : writers)
        writer.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_LE(files_in(folder.path()), 7u);
}

TEST(FileCache, an_entry_under_another_name_is_a_miss) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), k_plenty);
    cache.keep(key("a"), "the one");
    cache.keep(key("b"), "the other");
    fs::copy_file(folder / key("a"), folder / key("b"), fs::copy_options::overwrite_existing);
    EXPECT_EQ(cache.find(key("b")), std::nullopt);
    EXPECT_EQ(cache.find(key("a")), "the one");
}

TEST(FileCache, a_link_is_replaced_and_its_target_untouched) {
    const TemporaryFolder folder, elsewhere;
    const FileCache cache(folder / "cache", k_plenty);
    FileCache(elsewhere.path(), k_plenty).keep(key("a"), "somebody's");
    const std::string before = bytes_of(elsewhere / key("a"));
    cache.keep(key("b"), "makes the folder");
    fs::create_symlink(elsewhere / key("a"), folder.path() / "cache" / key("a"));
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
    cache.keep(key("a"), "ours");
    EXPECT_EQ(cache.find(key("a")), "ours");
    EXPECT_EQ(bytes_of(elsewhere / key("a")), before);
    EXPECT_FALSE(fs::is_symlink(folder.path() / "cache" / key("a")));
}

TEST(FileCache, a_pipe_is_not_waited_for) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), k_plenty);
    ASSERT_EQ(::mkfifo((folder / key("a")).c_str(), 0600), 0);
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
    cache.keep(key("a"), "ours");
    EXPECT_EQ(cache.find(key("a")), "ours");
}

TEST(FileCache, a_folder_that_is_a_link_is_left_alone) {
    const TemporaryFolder folder, elsewhere;
    save_in_place(elsewhere / "letter", std::string(5000, 'x'));
    fs::create_directory_symlink(elsewhere.path(), folder / "cache");
    const FileCache cache(folder / "cache", 1000);
    cache.keep(key("a"), "ours");
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
    EXPECT_EQ(files_in(elsewhere.path()), 1u);
}

TEST(FileCache, a_folder_writable_by_other_users_is_left_alone) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "cache");
    const FileCache cache(folder / "cache", k_plenty);
    cache.keep(key("a"), "ours");
    EXPECT_EQ(cache.find(key("a")), "ours");
    fs::permissions(folder / "cache", fs::perms::all);
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
    cache.keep(key("b"), "ours");
    EXPECT_EQ(files_in(folder / "cache"), 1u);
}

TEST(FileCache, a_new_folder_is_private_to_the_user) {
    const TemporaryFolder folder;
    FileCache(folder / "cache", k_plenty).keep(key("a"), "ours");
    EXPECT_EQ(fs::status(folder / "cache").permissions(), fs::perms::owner_all);
}

TEST(FileCache, another_users_folder_and_entries_are_left_alone) {
    if (::geteuid() != 0)
        GTEST_SKIP() << "only root gives files away";
    const TemporaryFolder folder;
    const FileCache cache(folder / "cache", k_plenty);
    cache.keep(key("a"), "ours");
    ASSERT_EQ(::chown((folder.path() / "cache" / key("a")).c_str(), 65534, 65534), 0);
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
    cache.keep(key("a"), "ours");
    ASSERT_EQ(::chown((folder / "cache").c_str(), 65534, 65534), 0);
    EXPECT_EQ(cache.find(key("a")), std::nullopt);
}

TEST(FileCache, foreign_files_are_kept) {
    const TemporaryFolder folder, elsewhere;
    const std::string large(5000, 'x');
    save_in_place(folder / "letter", large);
    save_in_place(folder / (key("a") + ".txt"), large);
    fs::create_directory(folder / key("folder"));
    save_in_place(elsewhere / "kept", large);
    fs::create_symlink(elsewhere / "kept", folder / key("link"));
    const FileCache cache(folder.path(), 1000);
    for (const char* name : {"a", "b", "c", "d", "e", "f", "g"})
        cache.keep(key(name), std::string(200, 'y')); // three of them fit
    EXPECT_EQ(bytes_of(folder / "letter"), large);
    EXPECT_EQ(bytes_of(folder / (key("a") + ".txt")), large);
    EXPECT_TRUE(fs::is_directory(folder / key("folder")));
    EXPECT_TRUE(fs::is_symlink(folder / key("link")));
    EXPECT_EQ(bytes_of(elsewhere / "kept"), large);
    EXPECT_EQ(files_in(folder.path()), 4u + 3u);
}

/// Sets variables for a test and puts them back.
class UserCache : public testing::Test {
protected:
    void SetUp() override {
        for (size_t i = 0; i < std::size(k_names); ++i)
            if (const char* value = std::getenv(k_names[i]))
                before_[i] = value;
    }
    void TearDown() override {
        for (size_t i = 0; i < std::size(k_names); ++i)
            set(k_names[i], before_[i] ? before_[i]->c_str() : nullptr);
    }
    static void set(const char* name, const char* value) {
        value ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    static std::optional<fs::path> folder(const char* wish, const char* cache, const char* home) {
        set("TIDEMARK_CACHE", wish);
        set("XDG_CACHE_HOME", cache);
        set("HOME", home);
        return user_cache_folder();
    }

private:
    static constexpr const char* k_names[] = {"TIDEMARK_CACHE", "XDG_CACHE_HOME", "HOME"};
    std::optional<std::string> before_[3];
};

TEST_F(UserCache, follows_the_xdg_variables) {
    const TemporaryFolder home;
    const char* me = home.path().c_str();
    EXPECT_EQ(folder(nullptr, "/var/cache/me", me), "/var/cache/me/tidemark");
    EXPECT_EQ(folder(nullptr, nullptr, me), home / ".cache/tidemark");
    EXPECT_EQ(folder(nullptr, "", me), home / ".cache/tidemark");
    EXPECT_EQ(folder(nullptr, "not/absolute", me), home / ".cache/tidemark");
    EXPECT_EQ(folder(nullptr, nullptr, nullptr), std::nullopt);
    EXPECT_EQ(folder(nullptr, nullptr, (home / "none").c_str()), std::nullopt) << "nobody lives there";
    EXPECT_EQ(folder("off", "/var/cache/me", me), std::nullopt);
    EXPECT_EQ(folder("on", "/var/cache/me", me), "/var/cache/me/tidemark");
}

} // namespace tidemark::file_cache_test
