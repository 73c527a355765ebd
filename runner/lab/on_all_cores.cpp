#include "lab/on_all_cores.hpp"

#include <atomic>
#include <system_error>
#include <thread>
#include <vector>

namespace tidemark::lab {

bool on_all_cores(size_t count, const KeepGoing& keep_going, const std::function<void(size_t)>& work) {
    std::atomic<size_t> next{0};
    std::atomic<bool> going{true};
    const auto run = [&](const KeepGoing& ask) {
        for (size_t i = next++; i < count && going; i = next++) {
            if (ask())
                work(i);
            else
                going = false;
        }
    };
    std::vector<std::jthread> helpers;
    try {
        for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
            helpers.emplace_back(run, [] { return true; });
    } catch (const std::system_error&) { // thread limit reached: go on with fewer threads
    }
    run(keep_going);
    helpers.clear(); // joins the threads
    return going;
}

} // namespace tidemark::lab
