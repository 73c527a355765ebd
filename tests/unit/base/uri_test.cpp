#include "base/encoding.hpp"

#include <gtest/gtest.h>

namespace tidemark::uri_test {

TEST(Uri, paths_become_escaped_uris) {
    EXPECT_EQ(uri_reference("/a b/w\u00e4ves.glsl"), "file:///a%20b/w%C3%A4ves.glsl");
    EXPECT_EQ(uri_reference("b c.glsl"), "b%20c.glsl");
    EXPECT_EQ(uri_reference("/100%.glsl"), "file:///100%25.glsl");
}

TEST(Uri, uri_of_a_path_gives_the_path_back) {
    for (const char* path : {"/a", "/a b/%41#?.glsl", "/w\u00e4ves", "/\xff\xfe"})
        EXPECT_EQ(path_of_uri(uri_reference(path)), std::filesystem::path(path));
    EXPECT_EQ(path_of_uri("file://localhost/a%20b"), std::filesystem::path("/a b"));
    EXPECT_EQ(path_of_uri("file:///a/../b"), std::filesystem::path("/b"));
}

TEST(Uri, uris_of_other_machines_have_no_path) {
    for (const char* uri : {"", "untitled:1", "http://x/a", "file://other/a", "file:a", "file:///%zz",
                            "file:///%4", "file:///a%00b", "FILE"})
        EXPECT_FALSE(path_of_uri(uri)) << uri;
}

} // namespace tidemark::uri_test
