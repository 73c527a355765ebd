// Fuzzes what a client sends to `tidemark serve`: the address and the messages.
#include "fuzz.hpp"
#include "web/audience.hpp"
#include "web/request.hpp"

#include <string>

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string text(text_of(data, size));
    constexpr std::string_view k_token = "0123456789abcdef";
    const web::Knock knock{
        .target = text, .host = "localhost:1", .origin = "http://localhost:1", .upgrade = true};
    const bool let_in = web::answer_to(knock, k_token) == web::Answer::socket;
    REQUIRE(!let_in || text.find(k_token) != std::string::npos);
    const web::Knock strange{.target = "/socket?token=0123456789abcdef",
                             .host = text,
                             .origin = "http://evil.example",
                             .upgrade = true};
    REQUIRE(web::answer_to(strange, k_token) == web::Answer::forbidden);

    web::Inbox inbox;
    web::Audience audience({.send = [](web::ViewerId, const web::SharedMessage&) {}}, inbox);
    REQUIRE(audience.came(1));
    (void)audience.said(1, text);
    audience.left(1);
    inbox.wait(0);
    return 0;
}
