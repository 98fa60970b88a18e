# Writes OUTPUT, a header with a hash of SOURCES: the version of plans that are kept on disk.
set(hashes "")
foreach (source IN LISTS SOURCES)
  get_filename_component(name "${source}" NAME)
  file(SHA256 "${source}" hash)
  string(APPEND hashes "${name} ${hash}\n")
endforeach ()
string(SHA256 version "${hashes}")
file(WRITE "${OUTPUT}" "#define MEASUREDBRDF_PLAN_VERSION \"${version}\"\n")
