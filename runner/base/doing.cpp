#include "base/doing.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <new>

namespace tidemark {
namespace {

/// One per process, not per thread: a crash ends the whole process, whichever thread it happens on.
std::atomic<DoingPage*> the_page = nullptr;

int64_t now_nanoseconds() {
    return std::chrono::steady_clock::now().time_since_epoch().count();
}

} // namespace

DoingPage* DoingPage::make() {
    void* memory =
        ::mmap(nullptr, sizeof(DoingPage), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? nullptr : new (memory) DoingPage{};
}

/// A text that changes while it is read comes out mixed, which is acceptable in a message.
DoingPage::Seen DoingPage::seen() const {
    const size_t size = std::min<size_t>(size_, k_longest);
    if (size == 0)
        return {};
    return {std::string(what_, size), double(now_nanoseconds() - since_) / 1e9, starting_};
}

std::optional<DoingPage::Frame> DoingPage::frame() const {
    const int number = frame_;
    return number == k_no_frame ? std::nullopt : std::optional(Frame{number, begun_});
}

void DoingPage::note(std::string_view what, int64_t since, bool starting) {
    size_ = 0;
    what.copy(what_, k_longest);
    since_ = since;
    starting_ = starting;
    has_driver_ = has_driver_ || starting;
    size_ = uint32_t(std::min(what.size(), k_longest));
}

Doing::Doing(std::string_view what, Kind kind) {
    DoingPage* page = the_page;
    if (!page)
        return;
    before_ = page->seen();
    since_before_ = page->since_;
    page->note(what, now_nanoseconds(), kind == Kind::start);
}

Doing::~Doing() {
    if (DoingPage* page = the_page)
        page->note(before_.what, since_before_, before_.starting);
}

void Doing::note_on(DoingPage* page) {
    the_page = page;
}

void Doing::note_frame(std::optional<DoingPage::Frame> frame) {
    DoingPage* page = the_page;
    if (!page)
        return;
    page->begun_ = frame && frame->begun;
    page->frame_ = frame ? frame->number : DoingPage::k_no_frame;
}

void Doing::note_resumable() {
    if (DoingPage* page = the_page)
        page->resumable_ = true;
}

std::string Doing::left_behind() {
    DoingPage* page = the_page;
    if (!page)
        return {};
    std::string what = page->seen().what;
    page->note({}, 0, false);
    return what;
}

} // namespace tidemark
