// Turns Mesa's shader cache off if its disk is full. Mesa maps its cache files into memory, and on a full
// disk a write to one of them ends the process (SIGBUS). Must be called before a driver is loaded.
#pragma once

namespace tidemark::platform {

/// Disables Mesa's cache, for this process and its children, if the cache folder that the environment selects
/// has no room for the index that Mesa maps. Leaves no file there.
void do_without_full_driver_cache();

} // namespace tidemark::platform
