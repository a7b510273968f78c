# PTX as a string of C++: PTX, OUT.
file(READ ${PTX} text)
file(WRITE ${OUT} "R\"ptx(${text})ptx\"\n")
