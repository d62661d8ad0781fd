acinus_test(generate_test SOURCES generate_test.cpp LINK acinus::coupling)
acinus_test(audit_test SOURCES audit_test.cpp LINK acinus::coupling)
