#include "web/request.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tidemark::web::access_test {

constexpr std::string_view k_token = "0123456789abcdef";
constexpr std::string_view k_socket = "/socket?token=0123456789abcdef";

Answer to(Knock knock) {
    return answer_to(knock, k_token);
}

TEST(Access, accepts_requests_with_the_token) {
    EXPECT_EQ(to({.target = "/?token=0123456789abcdef", .host = "127.0.0.1:8080"}), Answer::page);
    EXPECT_EQ(to({.target = "/?a=b&token=0123456789abcdef", .host = "localhost:8080"}), Answer::page);
    EXPECT_EQ(to({.target = k_socket, .host = "[::1]:8080", .origin = "http://[::1]:8080", .upgrade = true}),
              Answer::socket);
    EXPECT_EQ(to({.target = k_socket, .host = "localhost", .upgrade = true}), Answer::socket) << "no browser";
}

TEST(Access, refuses_requests_without_a_token) {
    for (const std::string_view target :
         {"/?token=", "/?token=0123456789abcdeX", "/?token=0123456789abcdef0", "/socket",
          "/socket?tokens=0123456789abcdef", "", "?", "/elsewhere", "/socket?xtoken=0123456789abcdef"})
        EXPECT_EQ(to({.target = target, .host = "localhost:8080"}), Answer::forbidden) << target;
    EXPECT_EQ(to({.target = "/socket", .host = "localhost:8080", .upgrade = true}), Answer::forbidden);
}

TEST(Access, sends_the_page_without_a_token) {
    EXPECT_EQ(to({.target = "/", .host = "localhost:8080"}), Answer::page);
    EXPECT_EQ(to({.target = "/?id=3", .host = "localhost:8080"}), Answer::page);
    EXPECT_EQ(to({.target = "/", .host = "evil.example"}), Answer::forbidden);
    EXPECT_EQ(to({.target = "/", .host = "localhost:8080", .upgrade = true}), Answer::forbidden);
}

TEST(Access, accepts_named_forwarded_addresses) {
    const std::vector<std::string> origins{"https://name-8080.example.dev"};
    Knock knock{.target = k_socket,
                .host = "name-8080.example.dev",
                .origin = "https://name-8080.example.dev",
                .upgrade = true};
    EXPECT_EQ(answer_to(knock, k_token), Answer::forbidden);
    EXPECT_EQ(answer_to(knock, k_token, origins), Answer::socket);
    knock.host = "localhost:8080"; // a relay that writes the host anew
    EXPECT_EQ(answer_to(knock, k_token, origins), Answer::socket);
    knock.origin = "https://evil.example";
    EXPECT_EQ(answer_to(knock, k_token, origins), Answer::forbidden);
    knock = {.target = "/socket?token=0123456789abcdeX", .host = "name-8080.example.dev", .upgrade = true};
    EXPECT_EQ(answer_to(knock, k_token, origins), Answer::forbidden);
}

TEST(Access, parses_origins_and_ancestors) {
    for (const std::string_view good :
         {"http://localhost:8000", "https://name.example.dev", "http://[::1]:80"})
        EXPECT_TRUE(check_origin(good)) << good;
    for (const std::string_view bad :
         {"", "localhost", "https:", "https://", "https://*.a.dev", "https://a.dev/", "https://a.dev:0",
          "https://a.dev:x", "https://a..dev", "HTTPS://a.dev", "ftp://a.dev", "http://[::1", "http://[]"})
        EXPECT_FALSE(check_origin(bad)) << bad;
    for (const std::string_view good :
         {"vscode-webview:", "https://*.vscode-cdn.net", "http://localhost:8000", "vscode-webview://0a1b2c",
          "https://editor.example"})
        EXPECT_TRUE(check_ancestor(good)) << good;
    for (const std::string_view bad :
         {"", "*", ":", "'self'", "https:", "http:", "data:", "https://*", "https://a; script-src *",
          "https://a b", "vscode-webview:x", "https://a/*", "1x:", "https://*.*.a"})
        EXPECT_FALSE(check_ancestor(bad)) << bad;
}

TEST(Access, has_a_page_and_a_socket) {
    EXPECT_EQ(to({.target = "/x?token=0123456789abcdef", .host = "localhost"}), Answer::not_found);
    EXPECT_EQ(to({.target = k_socket, .host = "localhost"}), Answer::not_found) << "no upgrade";
    EXPECT_EQ(to({.target = "/?token=0123456789abcdef", .host = "localhost", .upgrade = true}),
              Answer::not_found);
}

TEST(Access, refuses_foreign_origins) {
    for (const std::string_view origin :
         {"http://evil.example", "http://localhost:80", "null", "localhost:8080", "file://localhost:8080",
          "http://localhost:8080.evil.example"})
        EXPECT_EQ(to({.target = k_socket, .host = "localhost:8080", .origin = origin, .upgrade = true}),
                  Answer::forbidden)
            << origin;
    EXPECT_EQ(to({.target = k_socket,
                  .host = "localhost:8080",
                  .origin = "http://localhost:8080",
                  .upgrade = true}),
              Answer::socket);
}

/// The page of a name that was turned to the loopback has itself for an origin.
TEST(Access, refuses_foreign_host_names) {
    Knock knock{.target = k_socket, .host = "evil.example", .origin = "http://evil.example", .upgrade = true};
    EXPECT_EQ(to(knock), Answer::forbidden);
    knock.through_loopback = false;
    EXPECT_EQ(to(knock), Answer::socket) << "what --host says is reached by many names";
    EXPECT_EQ(to({.target = k_socket, .host = "127.evil.example", .upgrade = true}), Answer::forbidden);
    EXPECT_EQ(to({.target = k_socket, .host = "", .upgrade = true}), Answer::forbidden);
}

TEST(Access, makes_tokens_that_differ) {
    const auto one = make_token(), other = make_token();
    ASSERT_TRUE(one && other);
    EXPECT_THAT(*one, testing::MatchesRegex("[A-Za-z0-9_-]+"));
    EXPECT_EQ(one->size(), 22u);
    EXPECT_NE(*one, *other);
    EXPECT_TRUE(check_token(*one));
}

TEST(Access, requires_tokens_that_cannot_be_guessed) {
    EXPECT_FALSE(check_token("short"));
    EXPECT_FALSE(check_token("0123456789abcdef&"));
    EXPECT_FALSE(check_token(std::string(129, 'a')));
    EXPECT_EQ(
        check_token("secret").error().message,
        "the token has 6 characters: give 16 to 128 letters, digits, - or _, as in `openssl rand -hex 16`");
}

} // namespace tidemark::web::access_test
