#include "base/file_cache.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

namespace tidemark {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr uint64_t k_plenty = 1 << 20;

size_t files_in(const fs::path& folder) {
    return size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(FileCache, gives_back_what_was_kept) {
    const TemporaryFolder folder;
    const FileCache cache(folder / "made/when/needed", k_plenty);
    EXPECT_EQ(cache.find("a"), std::nullopt);
    const std::string bytes("a\0b\xff\n", 5);
    cache.keep("a", bytes);
    cache.keep("b", "");
    EXPECT_EQ(cache.find("a"), bytes);
    EXPECT_EQ(cache.find("b"), "");
    EXPECT_EQ(FileCache(folder / "made/when/needed", k_plenty).find("a"), bytes) << "in the next run";
    cache.keep("a", "other");
    EXPECT_EQ(cache.find("a"), "other");
}

TEST(FileCache, what_is_damaged_is_not_there) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), k_plenty);
    cache.keep("a", "some bytes of a program");
    const std::string whole = bytes_of(folder / "a");
    for (size_t i = 0; i < whole.size(); ++i) {
        std::string turned = whole;
        turned[i] = char(turned[i] ^ 1);
        save_in_place(folder / "a", turned);
        EXPECT_EQ(cache.find("a"), std::nullopt) << "bit turned in byte " << i;
        save_in_place(folder / "a", whole.substr(0, i));
        EXPECT_EQ(cache.find("a"), std::nullopt) << "cut to " << i << " bytes";
    }
    save_in_place(folder / "a", whole + "x");
    EXPECT_EQ(cache.find("a"), std::nullopt);
    save_in_place(folder / "a", whole);
    EXPECT_EQ(cache.find("a"), "some bytes of a program");
}

TEST(FileCache, no_folder_to_write_to_is_nobodys_business) {
    const TemporaryFolder folder;
    save_in_place(folder / "file");
    const FileCache cache(folder / "file/below", k_plenty);
    cache.keep("a", "bytes");
    EXPECT_EQ(cache.find("a"), std::nullopt);
    fs::create_directory(folder / "taken");
    const FileCache with_folder(folder.path(), k_plenty);
    with_folder.keep("taken", "bytes");
    EXPECT_EQ(with_folder.find("taken"), std::nullopt);
}

TEST(FileCache, what_was_not_asked_for_the_longest_goes_first) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), 1000);
    const std::string bytes(100, 'x'); // 164 with its digest: six of them fit
    for (const char* key : {"a", "b", "c", "d", "e", "f"})
        cache.keep(key, bytes);
    const auto now = fs::file_time_type::clock::now();
    int age = 100;
    for (const char* key : {"a", "b", "c", "d", "e", "f"})
        fs::last_write_time(folder / key, now - std::chrono::seconds(age--));
    EXPECT_EQ(cache.find("a"), bytes); // and is young again
    cache.keep("g", bytes);
    EXPECT_EQ(cache.find("b"), std::nullopt);
    for (const char* key : {"a", "c", "d", "e", "f", "g"})
        EXPECT_EQ(cache.find(key), bytes) << key;
    cache.keep("huge", std::string(501, 'x'));
    EXPECT_EQ(cache.find("huge"), std::nullopt) << "it would push out most others";
    EXPECT_EQ(files_in(folder.path()), 6u);
}

TEST(FileCache, half_written_files_of_the_dead_go_too) {
    const TemporaryFolder folder;
    save_in_place(folder / ".a.part-1-1", std::string(900, 'x'));
    fs::last_write_time(folder / ".a.part-1-1", fs::file_time_type::clock::now() - 1h);
    const FileCache cache(folder.path(), 1000);
    cache.keep("a", std::string(200, 'y'));
    EXPECT_FALSE(fs::exists(folder / ".a.part-1-1"));
    EXPECT_EQ(cache.find("a"), std::string(200, 'y'));
}

TEST(FileCache, writers_at_once_leave_something_whole) {
    const TemporaryFolder folder;
    const FileCache cache(folder.path(), 4000); // so that they also throw away each other's
    std::atomic<int> wrong = 0;
    std::vector<std::thread> writers;
    for (char name = 'a'; name < 'e'; ++name)
        writers.emplace_back([&, name] {
            for (int i = 0; i < 50; ++i) {
                const std::string key = std::to_string(i % 7);
                cache.keep(key, std::string(500, name));
                if (const auto found = cache.find(key))
                    wrong += *found != std::string(500, found->front());
            }
        });
    for (std::thread& writer : writers)
        writer.join();
    EXPECT_EQ(wrong, 0);
    EXPECT_LE(files_in(folder.path()), 7u);
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

TEST_F(UserCache, is_where_the_desktop_wants_it) {
    EXPECT_EQ(folder(nullptr, "/var/cache/me", "/home/me"), "/var/cache/me/tidemark");
    EXPECT_EQ(folder(nullptr, nullptr, "/home/me"), "/home/me/.cache/tidemark");
    EXPECT_EQ(folder(nullptr, "", "/home/me"), "/home/me/.cache/tidemark");
    EXPECT_EQ(folder(nullptr, "not/absolute", "/home/me"), "/home/me/.cache/tidemark");
    EXPECT_EQ(folder(nullptr, nullptr, nullptr), std::nullopt);
    EXPECT_EQ(folder("off", "/var/cache/me", "/home/me"), std::nullopt);
    EXPECT_EQ(folder("on", "/var/cache/me", "/home/me"), "/var/cache/me/tidemark");
}

} // namespace
} // namespace tidemark
