# cmake -DTESTS=LIST -DJOINED=FILE -P join.cmake: writes a source that compiles several tests at once.
# Their headers come first; then each test stands in a namespace of its own, where its own #include lines
# have nothing left to include.
set(headers "")
set(bodies "")
foreach(test ${TESTS})
    file(STRINGS ${test} lines REGEX "^#include ")
    list(APPEND headers ${lines})
    get_filename_component(name ${test} NAME_WE)
    string(APPEND bodies "namespace ${name} {\n#include \"${test}\"\n}\n")
endforeach()
list(REMOVE_DUPLICATES headers)
list(JOIN headers "\n" headers)
file(WRITE ${JOINED} "${headers}\n${bodies}")
