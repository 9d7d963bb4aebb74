// A source to compile the headers with that nearly every test includes (CMakeLists.txt).
