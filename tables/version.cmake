# cmake -DSOURCE=DIR -DVERSION=X.Y.Z -DGIT=PROGRAM -DHEADER=FILE -DROOMS="a;b" -P version.cmake
# writes the header that says which version and commit of SOURCE the program is built from, if it does
# not say so already. The commit is empty where SOURCE is not the top of a checkout.
cmake_minimum_required(VERSION 3.22)
set(ENV{GIT_OPTIONAL_LOCKS} 0)  # only looks

function(git out)
    set(${out} "" PARENT_SCOPE)
    if(NOT GIT)
        return()
    endif()
    execute_process(COMMAND ${GIT} -C ${SOURCE} ${ARGN} OUTPUT_VARIABLE text ERROR_QUIET
        RESULT_VARIABLE status OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(status EQUAL 0)
        set(${out} "${text}" PARENT_SCOPE)
    endif()
endfunction()

git(inside rev-parse --is-inside-work-tree)
git(folder rev-parse --show-prefix)
set(commit "")
if(inside STREQUAL "true" AND folder STREQUAL "")
    git(commit rev-parse --short=12 HEAD)
endif()
if(commit)
    git(changes diff --no-ext-diff --no-color HEAD -- ${ROOMS})
    git(others ls-files --others --exclude-standard -- ${ROOMS})
    if(NOT "${changes}${others}" STREQUAL "")
        string(SHA256 sum "${changes}${others}")
        string(SUBSTRING ${sum} 0 8 sum)
        string(APPEND commit "-dirty-${sum}")
    endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} @ONLY
    CONTENT "#define IRIDO_VERSION \"@VERSION@\"\n#define IRIDO_COMMIT \"@commit@\"\n")
