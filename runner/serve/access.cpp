#include "serve/access.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>

namespace tidemark::serve {
namespace {

constexpr std::string_view k_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
constexpr size_t k_token_letters = 22; // each holds 6 bits
constexpr size_t k_shortest = 16;
constexpr size_t k_longest = 128;

/// Returns the value of `token` in a query.
std::string_view token_in(std::string_view query) {
    constexpr std::string_view k_name = "token=";
    while (!query.empty()) {
        const size_t end = std::min(query.find('&'), query.size());
        if (query.starts_with(k_name))
            return query.substr(k_name.size(), end - k_name.size());
        query.remove_prefix(std::min(end + 1, query.size()));
    }
    return {};
}

/// Returns the host without the port.
std::string_view name_of(std::string_view host) {
    if (host.starts_with('['))
        return host.substr(0, host.find(']') + 1);
    return host.substr(0, host.find(':'));
}

bool is_loopback_name(std::string_view name) {
    const bool is_number = name.find_first_not_of("0123456789.") == std::string_view::npos;
    return name == "localhost" || name.ends_with(".localhost") || name == "[::1]" ||
           (is_number && name.starts_with("127."));
}

/// Returns whether an origin is `http://HOST` or `https://HOST` with that host.
bool is_own(std::string_view origin, std::string_view host) {
    const size_t scheme = origin.find("://");
    const std::string_view name = origin.substr(0, scheme);
    return scheme != std::string_view::npos && (name == "http" || name == "https") &&
           origin.substr(scheme + 3) == host;
}

} // namespace

Result<std::string> make_token() {
    std::array<unsigned char, k_token_letters> bytes{};
    if (::getrandom(bytes.data(), bytes.size(), 0) != ssize_t(bytes.size()))
        return fail(ErrorCode::load,
                    fmt::format("the system gives no random numbers: {}", system_reason(errno)));
    std::string token;
    for (const unsigned char byte : bytes)
        token += k_letters[byte % k_letters.size()];
    return token;
}

Result<void> check_token(std::string_view token) {
    const bool good = token.find_first_not_of(k_letters) == std::string_view::npos &&
                      token.size() >= k_shortest && token.size() <= k_longest;
    if (good)
        return {};
    return fail(ErrorCode::usage, fmt::format("the token has {} characters: give {} to {} letters, digits, - "
                                              "or _, as in `openssl rand -hex 16`",
                                              token.size(), k_shortest, k_longest));
}

bool is_same_token(std::string_view given, std::string_view right) {
    if (given.size() != right.size())
        return false; // the length is not secret
    unsigned char difference = 0;
    for (size_t i = 0; i < right.size(); ++i)
        difference |= static_cast<unsigned char>(given[i] ^ right[i]);
    return difference == 0;
}

Answer answer_to(const Knock& knock, std::string_view token) {
    const size_t question = std::min(knock.target.find('?'), knock.target.size());
    const std::string_view path = knock.target.substr(0, question);
    const std::string_view query = knock.target.substr(std::min(question + 1, knock.target.size()));
    if (knock.through_loopback && !is_loopback_name(name_of(knock.host)))
        return Answer::forbidden;
    if (!is_same_token(token_in(query), token))
        return Answer::forbidden;
    if (knock.upgrade && !knock.origin.empty() && !is_own(knock.origin, knock.host))
        return Answer::forbidden;
    if (path == "/socket" && knock.upgrade)
        return Answer::socket;
    return path == "/" && !knock.upgrade ? Answer::page : Answer::not_found;
}

} // namespace tidemark::serve
