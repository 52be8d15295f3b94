"""The benchmark: its cases, references and judge, the kit, and our own elements as entries."""
