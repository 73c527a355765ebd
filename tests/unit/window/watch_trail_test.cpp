#include "support/temporary_folder.hpp"
#include "window/file_watcher.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace tidemark::window {
namespace fs = std::filesystem;

void PrintTo(const Waypoint& waypoint, std::ostream* out) {
    *out << waypoint.folder << ' ' << waypoint.name;
}

namespace watch_trail_test {

using Trail = std::vector<Waypoint>;

TEST(WatchTrail, plain_file) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.glsl");
    EXPECT_EQ(trail_of(folder / "a.glsl"), (Trail{{folder.path(), "a.glsl"}}));
    EXPECT_EQ(trail_of(folder / "./x/../a.glsl"), (Trail{{folder.path(), "x"}}));
}

TEST(WatchTrail, a_slash_at_the_end_watches_the_folder) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "real");
    fs::create_symlink("real", folder / "link");
    EXPECT_EQ(trail_of(folder / "real/"), (Trail{{folder.path() / "real", ""}}));
    EXPECT_EQ(trail_of(folder / "link/"), (Trail{{folder.path(), "link"}, {folder.path() / "real", ""}}));
    EXPECT_EQ(trail_of(folder / "missing/"), (Trail{{folder.path(), "missing"}}));
}

TEST(WatchTrail, relative_path_starts_at_the_current_folder) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.glsl");
    const fs::path before = fs::current_path();
    fs::current_path(folder.path());
    const Trail trail = trail_of("a.glsl");
    fs::current_path(before);
    EXPECT_EQ(trail, (Trail{{folder.path(), "a.glsl"}}));
}

TEST(WatchTrail, a_link_and_its_target) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "real");
    save_in_place(folder / "real/a.glsl");
    fs::create_symlink("real/a.glsl", folder / "relative.glsl");
    fs::create_symlink(folder / "relative.glsl", folder / "absolute.glsl");
    EXPECT_EQ(trail_of(folder / "relative.glsl"),
              (Trail{{folder.path(), "relative.glsl"}, {folder / "real", "a.glsl"}}));
    EXPECT_EQ(trail_of(folder / "absolute.glsl"), (Trail{{folder.path(), "absolute.glsl"},
                                                         {folder.path(), "relative.glsl"},
                                                         {folder / "real", "a.glsl"}}));
}

TEST(WatchTrail, dot_dot_after_a_linked_folder_is_the_parent_of_the_target) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "deep/real");
    save_in_place(folder / "deep/a.glsl");
    fs::create_symlink("deep/real", folder / "link");
    EXPECT_EQ(trail_of(folder / "link/../a.glsl"),
              (Trail{{folder.path(), "link"}, {folder / "deep", "a.glsl"}}));
}

TEST(WatchTrail, stops_at_the_first_missing_name) {
    const TemporaryFolder folder;
    EXPECT_EQ(trail_of(folder / "a.glsl"), (Trail{{folder.path(), "a.glsl"}}));
    EXPECT_EQ(trail_of(folder / "x/y/a.glsl"), (Trail{{folder.path(), "x"}}));
    fs::create_symlink("nowhere/a.glsl", folder / "dangling");
    EXPECT_EQ(trail_of(folder / "dangling"),
              (Trail{{folder.path(), "dangling"}, {folder.path(), "nowhere"}}));
}

TEST(WatchTrail, circular_links_end) {
    const TemporaryFolder folder;
    fs::create_symlink("b", folder / "a");
    fs::create_symlink("a", folder / "b");
    EXPECT_EQ(trail_of(folder / "a").size(), 41u);
}

} // namespace watch_trail_test
} // namespace tidemark::window
