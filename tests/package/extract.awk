# Takes a page apart: each code block that follows a line `name`: becomes the file OUT/name, and the
# sh blocks, in their order, become OUT/commands.sh.
/^`[^`]+`:$/ { name = $0; gsub(/[`:]/, "", name); next }
/^```sh$/ { file = OUT "/commands.sh"; next }
/^```[a-z]+$/ && name != "" { file = OUT "/" name; next }
/^```/ { if (file != "") close(file) ; file = ""; name = ""; next }
file ~ /commands.sh$/ { print >> file; next }
file != "" { print > file }
