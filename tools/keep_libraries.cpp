// SPDX-License-Identifier: MIT
// For programs under sanitizers: libraries stay loaded to the end, so that what they leak is told by their names, and
// tests/support/lsan.supp can let it pass. Drivers are unloaded by other libraries, before leaks are looked for.
extern "C" int dlclose(void* library);
extern "C" int dlclose(void* /*library*/) { return 0; }
