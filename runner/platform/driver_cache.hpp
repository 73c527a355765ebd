// Mesa keeps compiled shaders in files that it maps into memory: on a disk that is full a write to one of
// them ends the process (SIGBUS). Asked for before a driver is loaded.
#pragma once

namespace tidemark::platform {

/// Has Mesa do without its cache, in this process and those that it starts, where the folder that the
/// environment leads it to has no room for what it maps. Leaves nothing in that folder.
void do_without_full_driver_cache();

} // namespace tidemark::platform
