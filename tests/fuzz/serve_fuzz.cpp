// What a browser, or somebody who says to be one, sends to `tidemark serve`: its address, and its messages.
#include "fuzz.hpp"
#include "web/audience.hpp"
#include "web/request.hpp"

#include <string>

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string text(text_of(data, size));
    constexpr std::string_view k_token = "0123456789abcdef";
    const serve::Knock knock{
        .target = text, .host = "localhost:1", .origin = "http://localhost:1", .upgrade = true};
    const bool let_in = serve::answer_to(knock, k_token) == serve::Answer::socket;
    REQUIRE(!let_in || text.find(k_token) != std::string::npos);
    const serve::Knock strange{.target = "/socket?token=0123456789abcdef",
                               .host = text,
                               .origin = "http://evil.example",
                               .upgrade = true};
    REQUIRE(serve::answer_to(strange, k_token) == serve::Answer::forbidden);

    serve::Inbox inbox;
    serve::Audience audience({.send = [](serve::ViewerId, const serve::SharedMessage&) {}}, inbox);
    REQUIRE(audience.came(1));
    (void)audience.said(1, text);
    audience.left(1);
    inbox.wait(0);
    return 0;
}
