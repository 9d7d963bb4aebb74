// A source to compile the headers with that nearly every source of the host includes (CMakeLists.txt).
