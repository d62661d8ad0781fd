# Most of the time of a source goes into headers that its neighbours include too: sources of a target are compiled a dozen at a
# time, which takes half of the time. Names in anonymous namespaces must differ within a target. OFF suits work on one file.
option(ACINUS_UNITY "Compile the sources of a target in groups" ON)

# acinus_unity(targets...)
function(acinus_unity)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ${ACINUS_UNITY} UNITY_BUILD_BATCH_SIZE 12)
endfunction()
