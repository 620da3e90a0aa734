// SPDX-License-Identifier: MIT
// A console script -> commands that act on a session with a small scene. Requests (pictures, scenes, films) are
// dropped: what they name is read by other targets. What commands write stays in one folder, so scripts that name
// another one are left alone.
#include "console/console.h"

#include <algorithm>
#include <string>

#include "cpu/console_test_support.h"
#include "folder.h"
#include "guests.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    conelight::program::registerGuests();
    std::filesystem::current_path(conelight::fuzz::folder());
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    namespace fs = std::filesystem;
    const std::string text(reinterpret_cast<const char*>(data), size);
    if (text.find('/') != std::string::npos) return -1;
    {
        conelight::test::ConsoleRig rig;
        rig.console.submit(text);
        // Copies of copies, of anything: a script may ask for more memory than there is, which is not looked for.
        constexpr std::size_t kMostInstances = 4096;
        for (int turn = 0; turn < 64 && !rig.console.idle(); ++turn) {
            rig.console.runQueued();
            while (rig.session.takeRequest()) {
            }
            if (rig.session.playing()) rig.session.finishPlaying();
            rig.console.endWait();
            if (rig.session.scene().instances.size() > kMostInstances) break;
        }
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(".")) fs::remove_all(entry.path());
    return 0;
}
